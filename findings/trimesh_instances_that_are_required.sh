#!/usr/bin/env bash
# trimesh 5.2.0: a glTF file whose extensionsRequired names what trimesh doesn't know is read all the same, without a
# warning, though glTF 2.0 (3.12) has it that such a file must not be loaded. With EXT_mesh_gpu_instancing, by which
# trees and grass are packed, one of all the copies is there. Seen: of three triangles at x = 0, 5 and 10 the first alone.
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

corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], np.float32)
places = np.array([[0, 0, 0], [5, 0, 0], [10, 0, 0]], np.float32)
data = base64.b64encode(corners.tobytes() + places.tobytes()).decode()
extension = "EXT_mesh_gpu_instancing"
accessor = {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}
root = {
    "asset": {"version": "2.0"},
    "extensionsUsed": [extension],
    "extensionsRequired": [extension],
    "scene": 0,
    "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0, "extensions": {extension: {"attributes": {"TRANSLATION": 1}}}}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "buffers": [{"byteLength": 72, "uri": f"data:application/octet-stream;base64,{data}"}],
    "bufferViews": [{"buffer": 0, "byteLength": 72}],
    "accessors": [accessor | {"min": [0, 0, 0], "max": [1, 1, 0]}, accessor | {"byteOffset": 36}],
}
with open("triangles.gltf", "w") as file:
    json.dump(root, file)
required = pygltflib.GLTF2().load("triangles.gltf").extensionsRequired
mesh = trimesh.load("triangles.gltf", force="mesh")
print("trimesh", trimesh.__version__, len(mesh.faces), mesh.bounds.tolist(), "required:", required)
assert required == [extension]
assert len(mesh.faces) == 1, "instances are read now"
PYTHON
