#!/usr/bin/env bash
# Pillow 12.0.0: of one orientation tag (6, a quarter turn) in three files, TIFF's is followed when pixels are read, and
# PNG's and JPEG's aren't: the same picture stands upright or lies on its side, by its format.
# Seen: (2, 3) pixels of the TIFF, (3, 2) of the PNG and the JPEG.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/env"
"$folder/env/bin/python" -m pip install --quiet --disable-pip-version-check pillow==12.0.0
"$folder/env/bin/python" - <<'PYTHON'
import io

import PIL
from PIL import Image

exif = Image.Exif()
exif[0x0112] = 6
sizes = {}
for kind in ("TIFF", "PNG", "JPEG"):
    file = io.BytesIO()
    Image.new("RGB", (3, 2), (200, 0, 0)).save(file, kind, exif=exif)
    image = Image.open(file)
    image.load()
    sizes[kind] = image.size
print("Pillow", PIL.__version__, sizes)
assert sizes == {"TIFF": (2, 3), "PNG": (3, 2), "JPEG": (3, 2)}, "orientation is followed in another way now"
PYTHON
