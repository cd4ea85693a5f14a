#!/usr/bin/env bash
# imageio 2.38.1 beside opencv-python-headless 5.0.0.93: imread of a Radiance picture (.hdr) takes OpenCV, and returns
# uint8. All that is brighter than 1 is cut off, and a lamp of radiance 16 is as bright as white paper; no error, no
# warning. With flags=cv2.IMREAD_UNCHANGED the numbers are there.
# Seen: uint8, 255 for the radiances 1 and 16; float32, 1 and 16 with the flag.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install --quiet --disable-pip-version-check imageio==2.38.1 opencv-python-headless==5.0.0.93 numpy==2.3.5
venv/bin/python -W error - <<'PYTHON'
from pathlib import Path

import cv2
import imageio
import imageio.v3 as iio

pixels = bytes([128, 128, 128, 129, 128, 128, 128, 133])
Path("a.hdr").write_bytes(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n" + pixels)
plain = iio.imread("a.hdr")
whole = iio.imread("a.hdr", flags=cv2.IMREAD_UNCHANGED)
seen = str(plain.dtype), plain[0, :, 0].tolist(), str(whole.dtype), whole[0, :, 0].tolist()
print("imageio", imageio.__version__, *seen)
assert seen == ("uint8", [255, 255], "float32", [1, 16]), "imageio keeps radiance now"
PYTHON
