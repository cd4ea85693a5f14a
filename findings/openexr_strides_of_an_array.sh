#!/usr/bin/env bash
# OpenEXR 3.5.3 (its own Python package): an array is written as if it were contiguous, whatever its strides. A picture
# that was turned by `transpose` is scrambled in the file, without an error or a warning. Seen: of a 3 x 2 picture with
# rows [0 2 4] and [1 3 5], a file with [0 1 2] and [3 4 5]; OpenImageIO 3.2.2.0 writes the same array rightly.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install --quiet --disable-pip-version-check numpy==2.4.6 OpenEXR==3.5.3 OpenImageIO==3.2.2.0
venv/bin/python - <<'PYTHON'
import numpy as np
import OpenEXR
import OpenImageIO

turned = np.arange(6, dtype=np.float32).reshape(3, 2).T
with OpenEXR.File({"type": OpenEXR.scanlineimage}, {"Z": turned}) as picture:
    picture.write("turned.exr")
with OpenEXR.File("turned.exr") as picture:
    found = picture.channels()["Z"].pixels.tolist()
other = OpenImageIO.ImageBuf(OpenImageIO.ImageSpec(3, 2, 1, "float"))
other.set_pixels(OpenImageIO.ROI(), turned[..., None])
print("OpenEXR", OpenEXR.__version__, found, "OpenImageIO", other.get_pixels()[..., 0].tolist())
assert turned.tolist() == [[0, 2, 4], [1, 3, 5]]
assert other.get_pixels()[..., 0].tolist() == turned.tolist()
assert found == [[0, 1, 2], [3, 4, 5]], "strides are followed now"
PYTHON
