#!/usr/bin/env bash
# mitsuba 3.9.1: an OpenEXR picture that holds a region of a larger one (a data window within the display window, as
# crops are written) is read as that region alone. Neither the size of the whole nor the region's place is kept, so that
# it can't be put back. Seen: of 3 x 2 pixels at (10, 5) in 32 x 24, a bitmap of 3 x 2; OpenImageIO 3.2.2.0 tells both.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install --quiet --disable-pip-version-check numpy==2.4.6 OpenEXR==3.5.3 OpenImageIO==3.2.2.0 mitsuba==3.9.1
venv/bin/python - <<'PYTHON'
import mitsuba
import numpy as np
import OpenEXR
import OpenImageIO

mitsuba.set_variant("scalar_rgb")
windows = {"dataWindow": ((10, 5), (12, 6)), "displayWindow": ((0, 0), (31, 23))}
about = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage, **windows}
with OpenEXR.File(about, {"RGB": np.ones((2, 3, 3), np.float32)}) as picture:
    picture.write("region.exr")
bitmap, told = mitsuba.Bitmap("region.exr"), OpenImageIO.ImageBuf("region.exr").spec()
place = (told.x, told.y, told.full_width, told.full_height)
names = sorted(bitmap.metadata().keys())
print("mitsuba", mitsuba.__version__, tuple(bitmap.size()), names, "OpenImageIO", place)
assert place == (10, 5, 32, 24)
assert tuple(bitmap.size()) == (3, 2), "the whole picture is read now"
assert not any("window" in name.lower() and name != "screenWindowWidth" for name in names), "its place is kept now"
PYTHON
