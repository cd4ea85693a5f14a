#!/usr/bin/env bash
# trimesh 5.2.0: a text STL that says "end facet" and "end solid", as some programs write it, has no triangles, and
# no error is raised. The same file with "endfacet" and "endsolid" has one.
# Seen: 0 faces, and 1 face.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/env"
"$folder/env/bin/python" -m pip install --quiet --disable-pip-version-check trimesh==5.2.0 numpy==2.3.5
"$folder/env/bin/python" - <<'PYTHON'
import io

import trimesh

text = """solid plate
facet normal 0 0 1
outer loop
vertex 0 0 0
vertex 1 0 0
vertex 1 1 0
end loop
end facet
end solid plate
"""


def faces(content):
    found = trimesh.exchange.stl.load_stl(io.BytesIO(content.encode()))
    geometries = found.get("geometry", {"": found})
    return sum(len(each["faces"]) for each in geometries.values() if each.get("faces") is not None)


counts = faces(text), faces(text.replace("end ", "end"))
print("trimesh", trimesh.__version__, "faces", counts)
assert counts == (0, 1), "words with a space are read now"
PYTHON
