#!/usr/bin/env bash
# IPython 9.18.1: a cell whose second line begins with >>> loses that prompt everywhere, within texts too. The cell is
# valid Python, and s is another text in Jupyter than in a file.
# Seen: '\nf(1)\n' in the place of '\n>>> f(1)\n'.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/env"
"$folder/env/bin/python" -m pip install --quiet --disable-pip-version-check ipython==9.18.1
"$folder/env/bin/python" - <<'PYTHON'
import IPython
from IPython.core.inputtransformer2 import TransformerManager

cell = 's = """\n>>> f(1)\n"""\n'
python, jupyter = {}, {}
exec(cell, python)
exec(TransformerManager().transform_cell(cell), jupyter)
print("IPython", IPython.__version__)
print("as a file:", repr(python["s"]))
print("in a cell:", repr(jupyter["s"]))
assert python["s"] == "\n>>> f(1)\n"
assert jupyter["s"] == "\nf(1)\n", "IPython leaves texts alone now"
PYTHON
