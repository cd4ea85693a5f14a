#!/usr/bin/env bash
# meshio 5.3.5: reading a PLY file with an element that it doesn't know ends the program: meshio.read raises SystemExit,
# which `except Exception` doesn't catch. The file is valid; other programs skip such elements, or read them.
# Seen: SystemExit(1) for a file with triangle strips.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install --quiet --disable-pip-version-check meshio==5.3.5 numpy==2.3.5
venv/bin/python - <<'PYTHON'
from pathlib import Path

import meshio

header = ["ply", "format ascii 1.0", "element vertex 4"]
header += [f"property float {axis}" for axis in "xyz"]
header += ["element tristrips 1", "property list int int vertex_indices", "end_header"]
Path("strip.ply").write_text("\n".join([*header, "0 0 0", "1 0 0", "0 1 0", "1 1 0", "4 0 1 2 3", ""]))
ended = None
try:
    meshio.read("strip.ply")
except SystemExit as end:
    ended = end.code
print("meshio", meshio.__version__, "SystemExit", ended)
assert ended == 1, "meshio doesn't end the program now"
PYTHON
