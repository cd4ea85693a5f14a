#!/usr/bin/env bash
# IPython 9.18.1: with a comment above %%time the cell is no cell magic any more, but a line magic whose name is
# "%time". That is not found, and nothing of the cell runs: neither is it timed, nor are its names defined.
# Seen: "UsageError: Line magic function `%%time` not found.", then x is not defined.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/env"
"$folder/env/bin/python" -m pip install --quiet --disable-pip-version-check ipython==9.18.1
cd "$folder"
IPYTHONDIR="$folder/ipython" "$folder/env/bin/python" - <<'PYTHON'
import IPython
from IPython.core.interactiveshell import InteractiveShell

shell = InteractiveShell.instance()
print("IPython", IPython.__version__)
assert shell.run_cell("%%time\ny = 1\n").success
commented = shell.run_cell("# how long does it take?\n%%time\nx = 1\n")
print("y:", shell.user_ns.get("y"), "x:", shell.user_ns.get("x", "not defined"))
assert shell.user_ns["y"] == 1
assert not commented.success and "x" not in shell.user_ns, "a comment may stand above a magic now"
PYTHON
