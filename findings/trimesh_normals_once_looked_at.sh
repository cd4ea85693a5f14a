#!/usr/bin/env bash
# trimesh 5.2.0: whether a PLY or OBJ file has normals depends on whether somebody has looked at them before. A mesh that is
# exported has none; after a mere `mesh.vertex_normals` the same call writes them, as means over the faces around. So
# renderers show a box with edges in one run, and with smoothed corners in the other.
# Seen: for a box, no nx in the PLY and no vn in the OBJ file before, and both after the attribute was read.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install --quiet --disable-pip-version-check numpy==2.4.6 trimesh==5.2.0
venv/bin/python -W error - <<'PYTHON'
import trimesh

found = []
for looked in (False, True):
    mesh = trimesh.creation.box()
    if looked:
        assert mesh.vertex_normals.shape == (8, 3)
    ply, obj = mesh.export(file_type="ply"), mesh.export(file_type="obj")
    found.append((b"property float nx" in ply, "\nvn " in obj))
print("trimesh", trimesh.__version__, "normals in PLY, OBJ:", found)
assert found == [(False, False), (True, True)], "looking at normals changes no file now"
PYTHON
