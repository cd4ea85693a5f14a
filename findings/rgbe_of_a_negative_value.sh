#!/usr/bin/env bash
# OpenImageIO 3.2.2.0 and mitsuba 3.9.1: a negative number in a picture that is written as Radiance (.hdr, RGBE, which has
# no signs) comes back as a positive one, and often as the brightest of its pixel; no error, no warning. Filters with
# negative lobes and subtractions make such numbers. Seen: (-1, 0.5, 2) becomes (3, 0.5, 2) in both; red was the darkest.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install --quiet --disable-pip-version-check numpy==2.4.6 OpenImageIO==3.2.2.0 mitsuba==3.9.1
venv/bin/python - <<'PYTHON'
import mitsuba
import numpy as np
import OpenImageIO
from OpenImageIO import ROI, ImageBuf, ImageSpec

mitsuba.set_variant("scalar_rgb")
# Of eight pixels in a row, for shorter ones aren't written as runs.
row = np.tile(np.float32([-1, 0.5, 2]), (1, 8, 1))
buffer = ImageBuf(ImageSpec(8, 1, 3, "float"))
buffer.set_pixels(ROI(0, 8, 0, 1, 0, 1, 0, 3), row)
assert buffer.write("openimageio.hdr")
mitsuba.Bitmap(row).write("mitsuba.hdr")
found = {}
for name, version in (("openimageio", OpenImageIO.__version__), ("mitsuba", mitsuba.__version__)):
    by_mitsuba = np.array(mitsuba.Bitmap(f"{name}.hdr"))[0, 0].tolist()
    by_openimageio = ImageBuf(f"{name}.hdr").get_pixels(OpenImageIO.FLOAT)[0, 0].tolist()
    assert by_mitsuba == by_openimageio
    found[f"{name} {version}"] = by_mitsuba
print(found)
assert list(found.values()) == [[3.0, 0.5, 2.0]] * 2, "negative values are written otherwise now"
PYTHON
