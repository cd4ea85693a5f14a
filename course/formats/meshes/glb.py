"""GLB (binary glTF 2.0) bytes to `Part`s: the file's default scene, flattened, by trimesh's parser.

The JSON is edited before trimesh reads it: uv would be read only along with a material and its
pictures, cameras and empty meshes would break the chain of nodes above their children, and
compressed or sparse data would come out as zeros.
"""

import json
import struct
from io import BytesIO
from typing import Any

import numpy as np
from numpy.typing import NDArray

from course.formats.meshes.parts import Part, part_of

UV = "_TEXCOORD_0"
POINTS_AND_LINES = range(4)
TRIANGLES_AND_STRIPS = (4, 5)
USED = ("POSITION", "NORMAL", "TEXCOORD_0")


def parse_glb(data: bytes) -> list[Part]:
    """Return the parts of a GLB file, one for each primitive and each node that shows it.

    Raises ValueError for what isn't GLB 2, and for compressed, quantised or sparse geometry, and triangle fans.
    """
    from trimesh.exchange.gltf import load_glb

    parsed = load_glb(BytesIO(_edited(data)), resolver=None, skip_materials=True)
    frames: dict[str, NDArray[np.float64]] = {parsed["base_frame"]: np.eye(4)}
    parts = []
    for edge in parsed["graph"]:
        matrix = frames[edge["frame_from"]] @ edge["matrix"]
        frames[edge["frame_to"]] = matrix
        if "geometry" in edge:
            geometry = parsed["geometry"][edge["geometry"]]
            part = part_of(geometry, matrix, uv=_uv(geometry))
            if part is not None:
                parts.append(part)
    return parts


def _uv(geometry: dict[str, Any]) -> NDArray[np.float64] | None:
    uv = geometry.get("vertex_attributes", {}).get(UV)
    if uv is None:
        return None
    # glTF: integers stand for 0..1, and v runs down from the picture's top row.
    unit = 1.0 / np.iinfo(uv.dtype).max if uv.dtype.kind == "u" else 1.0
    return np.stack([uv[:, 0] * unit, 1.0 - uv[:, 1] * unit], axis=1).astype(np.float64)


def _edited(data: bytes) -> bytes:
    """Return the same file with its JSON reduced to nodes and triangles."""
    if len(data) < 20 or data[:4] != b"glTF":
        raise ValueError("it doesn't begin as a GLB file does")
    length, kind = struct.unpack_from("<I4s", data, 12)
    if kind != b"JSON" or 20 + length > len(data):
        raise ValueError("its JSON chunk is missing or cut short")
    header = json.loads(data[20 : 20 + length])
    if not isinstance(header, dict):
        raise ValueError("its JSON isn't an object")
    _refuse_unreadable(header)
    for mesh in header.get("meshes", []):
        mesh["primitives"] = [
            _plain_primitive(header, p)
            for p in mesh["primitives"]
            if p.get("mode", 4) not in POINTS_AND_LINES
        ]
    for node in header.get("nodes", []):
        node.pop("camera", None)
        if "mesh" in node and not header["meshes"][node["mesh"]]["primitives"]:
            del node["mesh"]
    text = json.dumps(header).encode()
    text += b" " * (-len(text) % 4)
    rest = data[20 + length :]
    return (
        b"glTF"
        + data[4:8]
        + struct.pack("<II4s", 20 + len(text) + len(rest), len(text), b"JSON")
        + text
        + rest
    )


def _refuse_unreadable(header: dict[str, Any]) -> None:
    for name in header.get("extensionsRequired", []):
        if any(word in name.lower() for word in ("draco", "meshopt", "quantization")):
            raise ValueError(f"it needs {name}; export it without compression")


def _plain_primitive(header: dict[str, Any], primitive: dict[str, Any]) -> dict[str, Any]:
    """Return a primitive of positions, normals, uv and indices, all of them in the file."""
    if primitive.get("mode", 4) not in TRIANGLES_AND_STRIPS:
        raise ValueError("it holds triangle fans; export it as triangles")
    attributes = {k: v for k, v in primitive["attributes"].items() if k in USED}
    accessors = [*attributes.values(), *([primitive["indices"]] if "indices" in primitive else [])]
    for index in accessors:
        accessor = header["accessors"][index]
        if "sparse" in accessor or "bufferView" not in accessor:
            raise ValueError(f"accessor {index} is sparse or without data; export it in full")
    if "TEXCOORD_0" in attributes:
        attributes[UV] = attributes.pop("TEXCOORD_0")
    kept = {k: v for k, v in primitive.items() if k in ("indices", "mode")}
    return {"attributes": attributes, **kept}
