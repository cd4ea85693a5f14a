#!/usr/bin/env bash
# embreex 4.4.0.post1: a ray with a negative distance in `dists` counts as occluded (0), even where there is nothing at
# all on its line; INTERSECT says of the same ray that it hits nothing. Who masks out rays of a batch by negative
# distances, as Embree's own inactive rays have, finds them all in shadow.
# Seen: OCCLUDED [0, 0, -1] for distances [2, -1, 2], of which the first ray alone meets the triangle.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install --quiet embreex==4.4.0.post1 numpy==2.4.0
venv/bin/python - <<'PYTHON'
from importlib.metadata import version

import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene

scene = EmbreeScene()
TriangleMesh(
    scene,
    np.array([[-1, -1, 0], [1, -1, 0], [0, 1, 0]], np.float32),
    np.array([[0, 1, 2]], np.int32),
)
origins = np.array([[0, 0, -1], [5, 5, -1], [5, 5, -1]], np.float32)
directions = np.array([[0, 0, 1]] * 3, np.float32)


def ask(**query):
    return scene.run(origins, directions, np.array([2, -1, 2], np.float32), **query)


occluded = ask(query="OCCLUDED").tolist()
hits = ask(query="INTERSECT", output=True)["primID"].tolist()
print("embreex", version("embreex"), "OCCLUDED", occluded, "INTERSECT", hits)
assert hits == [0, -1, -1]
assert occluded == [0, 0, -1], "a negative distance is no occlusion now"
PYTHON
