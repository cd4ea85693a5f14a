#!/usr/bin/env bash
# mitsuba 3.9.1: a face of an OBJ file with four corners is cut along the diagonal from its first corner, wherever its
# reflex corner is. So the area of a dart depends on the corner at which the file begins it.
# Seen: 1 from the reflex corner and the one across, 3 from the others; the dart's area is 1.
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
corners, areas = [1, 2, 3, 4], []
for begin in range(4):
    face = " ".join(map(str, corners[begin:] + corners[:begin]))
    Path("a.obj").write_text(f"v 0 0 0\nv 2 0 0\nv .5 .5 0\nv 0 2 0\nf {face}\n")
    areas.append(round(float(mitsuba.load_dict({"type": "obj", "filename": "a.obj"}).surface_area()), 3))
print("mitsuba", mitsuba.__version__, "areas", areas)
assert areas == [1, 3, 1, 3], "Mitsuba looks at the corners now"
PYTHON
