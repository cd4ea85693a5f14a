#!/usr/bin/env bash
# mapbox_earcut 2.1.0: an outline that crosses itself can't be told by the areas, the usual check of a triangulation.
# Where it lies over itself, but turns one way on the whole, the triangles add up to the outline's own (shoelace) area.
# Seen: 8 triangles of 10 corners, areas 21.0 and 21.0, while the outline's last edge but one is crossed twice.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/env"
"$folder/env/bin/python" -m pip install --quiet --disable-pip-version-check mapbox_earcut==2.1.0 numpy==2.3.5
"$folder/env/bin/python" - <<'PYTHON'
import mapbox_earcut
import numpy as np

p = np.array([(0, 0), (6, 0), (6, 6), (2, 6), (2, -2), (3, -2), (3, 5), (5, 5), (5, 1), (0, 1)], float)
found = mapbox_earcut.triangulate_float64(p, np.array([10], np.uint32)).reshape(-1, 3)
a, b, c = (p[found[:, k]] for k in range(3))
areas = np.abs((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]) / 2
x, y = p.T
shoelace = abs(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))) / 2
print("mapbox_earcut", mapbox_earcut.__version__, len(found), "triangles, areas", areas.sum(), shoelace)
assert len(found) == 8 and areas.sum() == shoelace == 21, "areas tell that the outline crosses itself now"
PYTHON
