#!/usr/bin/env bash
# mitsuba 3.9.1: the first and the last row of an `envmap` lie *at* the poles, so that N rows are N - 1 steps apart; its
# columns are cells, of which N go around. Renderers that take rows as cells, too, as pixels of a picture are, put the
# sun up to half a row elsewhere. Seen: of 8 rows with the values 0 to 7, .4375 in the middle of the first of 8 cells.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install --quiet --disable-pip-version-check numpy==2.4.6 mitsuba==3.9.1
venv/bin/python - <<'PYTHON'
import mitsuba
import numpy as np

mitsuba.set_variant("scalar_rgb")
rows = 8
values = np.broadcast_to(np.arange(rows, dtype=np.float32)[:, None, None], (rows, 16, 3))
picture = mitsuba.Bitmap(np.ascontiguousarray(values))
scene = mitsuba.load_dict({"type": "scene", "sky": {"type": "envmap", "bitmap": picture}})
found = []
for row in range(rows):
    polar = (row + 0.5) / rows * np.pi
    seen = mitsuba.SurfaceInteraction3f()
    seen.wi = -mitsuba.Vector3f(np.sin(polar), np.cos(polar), 0)
    found.append(float(scene.environment().eval(seen)[0]))
print("mitsuba", mitsuba.__version__, np.round(found, 4).tolist())
steps = (np.arange(rows) + 0.5) / rows * (rows - 1)
assert np.allclose(found, steps, atol=1e-4), "rows are cells now"
PYTHON
