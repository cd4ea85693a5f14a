#!/usr/bin/env bash
# embreex 4.4.0.post1 (Embree 4.4.0, robust): the distance to a long thin triangle errs by up to 2^-24 length^2 / height
# if its third corner lies over the middle of its longest edge (a cap), but by a few 2^-24 of the length if two of
# its edges are long (a needle, as in a quad of two triangles), though both are as long and as high. The normal is a
# product of the two shorter edges: of a cap they are nearly parallel.
# Seen: 2 long and 2e-4 high, the largest error of some 8,000 rays is 2.0e-07 for needles and 1.5e-04 for caps.
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

HEIGHT = 2e-4


def largest_error(third):
    """Of the height of hits above the triangle's plane, of rays from 0.1 away at 30 degrees or more to it."""
    rng, largest = np.random.default_rng(1), 0.0
    flat = np.array([[-1.0, 0, 0], [1, 0, 0], third])
    for _ in range(40):
        turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
        corners = (flat @ turn.T).astype(np.float32)
        p = corners.astype(np.float64)
        normal = np.cross(p[1] - p[0], p[2] - p[0])
        normal /= np.linalg.norm(normal)
        away = rng.normal(size=(400, 3))
        away /= np.linalg.norm(away, axis=1)[:, None]
        away = away[np.abs(away @ normal) > 0.5]
        target = rng.dirichlet((1, 1, 1), len(away)) @ p
        origins = (target + 0.1 * away).astype(np.float32)
        directions = (target - origins).astype(np.float32)
        scene = EmbreeScene(robust=True)
        TriangleMesh(scene, corners, np.array([[0, 1, 2]], np.int32))
        found = scene.run(origins, directions, query="INTERSECT", output=True)
        hit = found["primID"] == 0
        heights = (origins - p[0]) @ normal + found["tfar"] * (directions @ normal)
        largest = max(largest, float(np.abs(heights[hit]).max()))
    return largest


needle, cap = largest_error([1, HEIGHT, 0]), largest_error([0.2, HEIGHT, 0])
print("embreex", version("embreex"), f"needles {needle:.1e}, caps {cap:.1e}")
assert needle < 4e-6
assert cap > 30 * needle, "caps are as exact as needles now"
PYTHON
