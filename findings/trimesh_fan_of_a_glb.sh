#!/usr/bin/env bash
# trimesh 5.2.0: a primitive of a GLB file whose mode is 6, TRIANGLE_FAN (glTF 2.0, 3.7.2.1), is left out without a
# warning, while one whose mode is 5, TRIANGLE_STRIP, is read.
# Seen: no geometry for the fan, one mesh of three triangles for the strip, of the same five vertices.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install --quiet --disable-pip-version-check trimesh==5.2.0 numpy==2.3.5
venv/bin/python -W error - <<'PYTHON'
import io
import json
import struct

import numpy as np
import trimesh


def glb(mode):
    content = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (-1, 1, 0)], "<f4").tobytes()
    position = {"bufferView": 0, "componentType": 5126, "count": 5, "type": "VEC3"}
    header = {
        "asset": {"version": "2.0"},
        "buffers": [{"byteLength": len(content)}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": len(content)}],
        "accessors": [position | {"min": [-1, 0, 0], "max": [1, 1, 0]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": mode}]}],
        "nodes": [{"mesh": 0}],
        "scenes": [{"nodes": [0]}],
        "scene": 0,
    }
    text = json.dumps(header).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text
    chunks += struct.pack("<I4s", len(content), b"BIN\0") + content
    return b"glTF" + struct.pack("<II", 2, 12 + len(chunks)) + chunks


faces = {
    mode: [len(part.faces) for part in trimesh.load_scene(io.BytesIO(glb(mode)), file_type="glb").geometry.values()]
    for mode in (5, 6)
}
print("trimesh", trimesh.__version__, "triangles by mode", faces)
assert faces == {5: [3], 6: []}, "trimesh reads fans now"
PYTHON
