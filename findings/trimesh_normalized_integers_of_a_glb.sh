#!/usr/bin/env bash
# trimesh 5.2.0: positions of a glTF file that are normalized integers (KHR_mesh_quantization, as packers of meshes write
# them, here asked for as required) are taken as they are stored. A triangle of sides 1 comes out 32767 times as large,
# without a word. Seen: corners (32767, 0, 0) and (0, 32767, 0); pygltflib 1.16.5 shows `normalized: True`.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install --quiet --disable-pip-version-check numpy==2.4.6 trimesh==5.2.0 pygltflib==1.16.5
venv/bin/python - <<'PYTHON'
import base64
import json

import numpy as np
import pygltflib
import trimesh

corners = np.array([[0, 0, 0, 0], [32767, 0, 0, 0], [0, 32767, 0, 0]], np.int16)
data = "data:application/octet-stream;base64," + base64.b64encode(corners.tobytes()).decode()
extension = "KHR_mesh_quantization"
accessor = {"bufferView": 0, "componentType": 5122, "normalized": True, "count": 3, "type": "VEC3"}
root = {
    "asset": {"version": "2.0"},
    "extensionsUsed": [extension],
    "extensionsRequired": [extension],
    "scene": 0,
    "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "buffers": [{"byteLength": 24, "uri": data}],
    "bufferViews": [{"buffer": 0, "byteLength": 24, "byteStride": 8}],
    "accessors": [accessor | {"min": [0, 0, 0], "max": [32767, 32767, 0]}],
}
with open("triangle.gltf", "w") as file:
    json.dump(root, file)
mesh = trimesh.load("triangle.gltf", force="mesh")
told = pygltflib.GLTF2().load("triangle.gltf").accessors[0].normalized
print("trimesh", trimesh.__version__, mesh.vertices.max(axis=0).tolist(), "pygltflib", told)
assert told is True
assert mesh.vertices.max(axis=0).tolist() == [32767, 32767, 0], "integers are normalized now"
PYTHON
