#!/usr/bin/env bash
# Pillow 13.0.0: a picture with alpha is scaled with its colours weighted by alpha, but blurred without. The colour of
# pixels that nobody can see, such as what a program left there, comes out at the edge of what is seen.
# Seen: beside opaque red, pixels of alpha 0 with blue codes: (170, 0, 85, 170) after BoxBlur, (255, 0, 0, 127) after
# a shift by half a pixel with `transform`.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install --quiet --disable-pip-version-check numpy==2.4.6 pillow==13.0.0
venv/bin/python -W error - <<'PYTHON'
import numpy as np
import PIL
from PIL import Image, ImageFilter

codes = np.zeros((1, 8, 4), np.uint8)
codes[0, :4], codes[0, 4:] = (255, 0, 0, 255), (0, 0, 255, 0)
picture = Image.fromarray(codes)
blurred = np.asarray(picture.filter(ImageFilter.BoxBlur((1, 0))))[0, 3].tolist()
half = (1, 0, 0.5, 0, 1, 0)
moved = np.asarray(picture.transform((8, 1), Image.Transform.AFFINE, half, Image.Resampling.BILINEAR))
moved = moved[0, 3].tolist()
print("Pillow", PIL.__version__, "blurred", blurred, "moved", moved)
assert moved == [255, 0, 0, 127]
assert blurred == [170, 0, 85, 170], "a blur weights colours by alpha now"
PYTHON
