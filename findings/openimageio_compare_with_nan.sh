#!/usr/bin/env bash
# OpenImageIO 3.2.2.0: ImageBufAlgo.compare, asked for the pixels that differ by more than a threshold, finds none where one
# of the two pictures isn't a number: nfail is 0 and error False. A picture of nothing but NaN passes as equal to any other;
# only meanerror and maxerror, which are NaN, show it, and neither of them is larger than a bound.
# Seen: of 16 pixels 0 fail for a picture of NaN beside one of 0.5, and 16 for one of 0.6.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install --quiet --disable-pip-version-check numpy==2.4.6 OpenImageIO==3.2.2.0
venv/bin/python - <<'PYTHON'
import numpy as np
import OpenImageIO
from OpenImageIO import ROI, ImageBuf, ImageBufAlgo, ImageSpec


def picture(value):
    made = ImageBuf(ImageSpec(4, 4, 3, "float"))
    made.set_pixels(ROI(0, 4, 0, 4, 0, 1, 0, 3), np.full((4, 4, 3), value, np.float32))
    return made


found = {}
for value in (0.6, np.nan):
    told = ImageBufAlgo.compare(picture(0.5), picture(value), 0.01, 0.01)
    found[value] = told.nfail, told.error, told.meanerror, told.maxerror
print("OpenImageIO", OpenImageIO.__version__, found)
assert found[0.6][:2] == (16, True)
assert found[np.nan][:2] == (0, False), "NaN fails now"
PYTHON
