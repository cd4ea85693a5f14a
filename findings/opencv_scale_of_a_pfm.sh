#!/usr/bin/env bash
# opencv-python-headless 5.0.0.93: the number in a PFM file's third line scales its values; OpenCV divides by it, while
# OpenImageIO 3.2.2.0 and mitsuba 3.9.1 multiply. Files whose number isn't 1 come out differently, and nothing is told.
# Seen: of a value 8 and a scale of 2, OpenCV makes 4, the two others 16.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install --quiet --disable-pip-version-check numpy==2.4.6 opencv-python-headless==5.0.0.93 \
  OpenImageIO==3.2.2.0 mitsuba==3.9.1
venv/bin/python - <<'PYTHON'
from pathlib import Path

import cv2
import mitsuba
import numpy as np
import OpenImageIO

mitsuba.set_variant("scalar_rgb")
Path("grey.pfm").write_bytes(b"Pf\n4 4\n-2.0\n" + np.full((4, 4), 8, "<f4").tobytes())
found = {
    f"OpenCV {cv2.__version__}": cv2.imread("grey.pfm", cv2.IMREAD_UNCHANGED),
    f"OpenImageIO {OpenImageIO.__version__}": OpenImageIO.ImageBuf("grey.pfm").get_pixels(OpenImageIO.FLOAT),
    f"mitsuba {mitsuba.__version__}": np.array(mitsuba.Bitmap("grey.pfm")),
}
values = [float(np.unique(picture)[0]) for picture in found.values()]
print(dict(zip(found, values)))
assert values == [4.0, 16.0, 16.0], "the scale of a PFM file is read otherwise now"
PYTHON
