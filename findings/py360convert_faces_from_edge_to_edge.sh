#!/usr/bin/env bash
# py360convert 1.0.4: a face of a cube map has its outermost samples on the cube's edges, and not half a texel within
# them, where graphics libraries look them up. Each edge is stored twice, and directions are up to a quarter of a texel
# off. Seen: on a face of 32 x 32 texels, .91 degrees from the texels' middles (a texel in the middle has 3.6), .00 from
# a grid that ends on the edges.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install --quiet --disable-pip-version-check numpy==2.4.6 py360convert==1.0.4
venv/bin/python - <<'PYTHON'
from importlib.metadata import version

import numpy as np
import py360convert

HEIGHT, WIDTH, FACE = 512, 1024, 32
down, right = np.meshgrid((np.arange(HEIGHT) + 0.5) / HEIGHT, (np.arange(WIDTH) + 0.5) / WIDTH, indexing="ij")
latitude, longitude = np.pi * (0.5 - down), 2 * np.pi * (right - 0.5)
# A panorama whose pixels hold their own directions.
across = np.cos(latitude)
panorama = np.stack([across * np.sin(longitude), np.sin(latitude), across * np.cos(longitude)], axis=-1)
front = py360convert.e2c(panorama, face_w=FACE, mode="bilinear", cube_format="dict")["F"]


def degrees(places):
    x, y = np.meshgrid(places, -places)
    wanted = np.stack([x, y, np.ones_like(x)], axis=-1)
    cosine = (front * wanted).sum(-1) / np.linalg.norm(front, axis=-1) / np.linalg.norm(wanted, axis=-1)
    return float(np.degrees(np.arccos(np.clip(cosine, -1, 1))).max())


middles, edges = degrees((np.arange(FACE) + 0.5) * 2 / FACE - 1), degrees(np.linspace(-1, 1, FACE))
print("py360convert", version("py360convert"), f"degrees from middles {middles:.2f}, from edge to edge {edges:.2f}")
assert middles > 0.8 and edges < 0.1, "the samples of a face lie elsewhere now"
PYTHON
