#!/usr/bin/env bash
# opencv-python-headless 5.0.0.93: pixels of a Radiance picture (.hdr) are returned as they are stored, though the
# header's EXPOSURE says that they were multiplied by it: radiance is the value divided by EXPOSURE (filefmts of
# Radiance). Light probes with such a line come out too bright or too dark, without a word.
# Seen: 1.0 with EXPOSURE=1 and with EXPOSURE=4, whose radiance is 0.25.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install --quiet --disable-pip-version-check opencv-python-headless==5.0.0.93 numpy==2.3.5
venv/bin/python - <<'PYTHON'
from pathlib import Path

import cv2

read = []
for exposure in (1, 4):
    header = f"#?RADIANCE\nEXPOSURE={exposure}\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n"
    Path("a.hdr").write_bytes(header.encode() + bytes([128, 128, 128, 129]) * 2)
    read.append(float(cv2.imread("a.hdr", cv2.IMREAD_UNCHANGED)[0, 0, 0]))
print("opencv", cv2.__version__, "by exposure", read)
assert read == [1, 1], "OpenCV divides by EXPOSURE now"
PYTHON
