#!/usr/bin/env bash
# numpy-stl 4.1.1: of an ASCII STL file with several solids, as CAD programs write parts, Mesh.from_file returns the
# first, without a warning. Mesh.from_multi_file returns all.
# Seen: 1 triangle of 2.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install --quiet --disable-pip-version-check numpy-stl==4.1.1 numpy==2.3.5
venv/bin/python -W error - <<'PYTHON'
from importlib.metadata import version
from pathlib import Path

from stl import mesh


def solid(name, z):
    corners = "".join(f"vertex {x} {y} {z}\n" for x, y in ((0, 0), (1, 0), (0, 1)))
    facet = f"facet normal 0 0 1\nouter loop\n{corners}endloop\nendfacet\n"
    return f"solid {name}\n{facet}endsolid {name}\n"


Path("two.stl").write_text(solid("lower", 0) + solid("upper", 1))
one = len(mesh.Mesh.from_file("two.stl").vectors)
every = sum(len(part.vectors) for part in mesh.Mesh.from_multi_file("two.stl"))
print("numpy-stl", version("numpy-stl"), "from_file", one, "from_multi_file", every)
assert (one, every) == (1, 2), "from_file reads all solids now"
PYTHON
