#!/usr/bin/env bash
# trimesh 5.2.0: a PLY file whose faces are triangle strips (`element tristrips`, as some programs of scanners write
# them) comes as a cloud of points. The strips are dropped without a warning.
# Seen: PointCloud, where the strip of four vertices is two triangles.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install --quiet --disable-pip-version-check trimesh==5.2.0 numpy==2.3.5
venv/bin/python -W error - <<'PYTHON'
from pathlib import Path

import trimesh

header = ["ply", "format ascii 1.0", "element vertex 4"]
header += [f"property float {axis}" for axis in "xyz"]
header += ["element tristrips 1", "property list int int vertex_indices", "end_header"]
Path("strip.ply").write_text("\n".join([*header, "0 0 0", "1 0 0", "0 1 0", "1 1 0", "4 0 1 2 3", ""]))
kinds = [type(part).__name__ for part in trimesh.load_scene("strip.ply").geometry.values()]
print("trimesh", trimesh.__version__, kinds)
assert kinds == ["PointCloud"], "trimesh reads strips now"
PYTHON
