#!/usr/bin/env bash
# Pillow 13.0.0: of a DDS file that holds a cube map (six faces, as skies and probes are packed) the first face is read
# as the whole picture; neither n_frames nor info tells of the other five. OpenImageIO 3.2.2.0 gives all six, one below
# the other. Seen: 2 x 2 pixels and one frame by Pillow, 2 x 12 by OpenImageIO, of faces of 2 x 2.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install --quiet --disable-pip-version-check numpy==2.4.6 pillow==13.0.0 OpenImageIO==3.2.2.0
venv/bin/python -W error - <<'PYTHON'
import struct

import OpenImageIO
import PIL
from PIL import Image

# The header of Microsoft's "DDS_HEADER": size, flags, height, width, pitch, depth, levels, 11 unused numbers, the
# format of the pixels (blue, green, red, alpha, 8 bits each), what it is (0x200: a cube map, 0xfc00: all its faces).
header = struct.pack("<7I44x", 124, 0x100F, 2, 2, 8, 0, 0)
header += struct.pack("<8I", 32, 0x41, 0, 32, 0xFF0000, 0xFF00, 0xFF, 0xFF000000)
header += struct.pack("<2I12x", 0x1008, 0xFE00)
faces = b"".join(bytes((40 * face, 10, 200, 255)) * 4 for face in range(6))
with open("cube.dds", "wb") as file:
    file.write(b"DDS " + header + faces)
with Image.open("cube.dds") as picture:
    picture.load()
    pillow = picture.size, getattr(picture, "n_frames", 1), dict(picture.info)
spec = OpenImageIO.ImageBuf("cube.dds").spec()
other = spec.width, spec.height
print(f"Pillow {PIL.__version__}", pillow, f"OpenImageIO {OpenImageIO.__version__}", other)
assert other == (2, 12)
assert pillow == ((2, 2), 1, {}), "Pillow tells of six faces now"
PYTHON
