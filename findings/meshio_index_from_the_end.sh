#!/usr/bin/env bash
# meshio 5.3.5: faces of an OBJ file that count vertices from the end (-1 is the last) are off by one. -1 comes as -2,
# which NumPy takes for the last but one, so the mesh is another one and nobody says so.
# Seen: the face "-3 -2 -1" of four vertices has x = 0, 1, 2; its vertices stand at x = 1, 2, 3.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install --quiet --disable-pip-version-check meshio==5.3.5 numpy==2.3.5
venv/bin/python - <<'PYTHON'
from pathlib import Path

import meshio

Path("a.obj").write_text("v 0 0 0\nv 1 0 0\nv 2 1 0\nv 3 0 0\nf -3 -2 -1\n")
mesh = meshio.read("a.obj")
(face,) = mesh.cells_dict["triangle"]
x = mesh.points[face, 0].tolist()
print("meshio", meshio.__version__, "indices", face.tolist(), "x", x)
assert x == [0, 1, 2], "meshio counts from the end as the file does now"
PYTHON
