#!/usr/bin/env bash
# trimesh 5.2.0: a skinned mesh of a GLB is moved by its own node, which glTF 2.0 (3.7.3.2) says to ignore: only the
# joints of a skin move it. No warning is given.
# Seen: x from 5 to 6, where the joint stands at the origin, and so x from 0 to 1 is right.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/env"
"$folder/env/bin/python" -m pip install --quiet --disable-pip-version-check trimesh==5.2.0 numpy==2.3.5
"$folder/env/bin/python" - <<'PYTHON'
import io
import json
import struct

import numpy as np
import trimesh

corners = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0)], "<f4").tobytes()
joints, weights = bytes(12), np.array([(1, 0, 0, 0)] * 3, "<f4").tobytes()
content = corners + joints + weights
views, accessors, at = [], [], 0
for data, component, kind in ((corners, 5126, "VEC3"), (joints, 5121, "VEC4"), (weights, 5126, "VEC4")):
    views.append({"buffer": 0, "byteOffset": at, "byteLength": len(data)})
    accessors.append({"bufferView": len(accessors), "componentType": component, "count": 3, "type": kind})
    at += len(data)
accessors[0] |= {"min": [0, 0, 0], "max": [1, 1, 0]}
header = {
    "asset": {"version": "2.0"},
    "buffers": [{"byteLength": len(content)}],
    "bufferViews": views,
    "accessors": accessors,
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}}]}],
    "nodes": [{"mesh": 0, "skin": 0, "translation": [5, 0, 0]}, {}],
    "skins": [{"joints": [1]}],
    "scenes": [{"nodes": [0, 1]}],
    "scene": 0,
}
text = json.dumps(header).encode()
text += b" " * (-len(text) % 4)
chunks = struct.pack("<I4s", len(text), b"JSON") + text
chunks += struct.pack("<I4s", len(content), b"BIN\0") + content
glb = b"glTF" + struct.pack("<II", 2, 12 + len(chunks)) + chunks
scene = trimesh.load_scene(io.BytesIO(glb), file_type="glb")
x = scene.bounds[:, 0].tolist()
print("trimesh", trimesh.__version__, "x", x)
assert x == [5, 6], "a skinned mesh isn't moved by its node now"
PYTHON
