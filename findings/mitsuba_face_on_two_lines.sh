#!/usr/bin/env bash
# mitsuba 3.9.1: a face of an OBJ file that goes on in the next line (a backslash at the end of the first, as the format
# has it for long statements) is left out. What is told, if anything, is that vertices without faces have no normals.
# Seen: 1 face of 2.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install --quiet --disable-pip-version-check mitsuba==3.9.1
venv/bin/python - <<'PYTHON'
from pathlib import Path

import mitsuba

mitsuba.set_variant("scalar_rgb")
Path("a.obj").write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 \\\n4\n")
faces = mitsuba.load_dict({"type": "obj", "filename": "a.obj"}).face_count()
print("mitsuba", mitsuba.__version__, "faces", faces)
assert faces == 1, "Mitsuba reads faces on two lines now"
PYTHON
