"""GLB files written by hand, from what the specification of glTF 2.0 says."""

import json
import struct
from typing import Any

import numpy as np
from numpy.typing import NDArray

SQUARE = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], "<f4")
KINDS = {"i1": 5120, "u1": 5121, "i2": 5122, "u2": 5123, "u4": 5125, "f4": 5126}
WIDTHS = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}


class Writer:
    """A file with a square of two triangles as mesh 0 in node 0, to be changed before it is written."""

    def __init__(self) -> None:
        self.binary = b""
        self.header: dict[str, Any] = {
            "asset": {"version": "2.0"},
            "bufferViews": [],
            "accessors": [],
            "nodes": [{"mesh": 0}],
            "scenes": [{"nodes": [0]}],
            "scene": 0,
        }
        indices = self.add(np.array([0, 1, 2, 0, 2, 3], "u1"))
        self.primitive: dict[str, Any] = {
            "attributes": {"POSITION": self.add(SQUARE)},
            "indices": indices,
        }
        self.header["meshes"] = [{"primitives": [self.primitive]}]

    def view(self, array: NDArray[Any]) -> int:
        """A view of a whole array."""
        self.binary += b"\0" * (-len(self.binary) % 4)
        at = {"buffer": 0, "byteOffset": len(self.binary), "byteLength": array.nbytes}
        self.header["bufferViews"].append(at)
        self.binary += array.tobytes()
        return len(self.header["bufferViews"]) - 1

    def add(self, array: NDArray[Any], **more: Any) -> int:
        """An accessor of an array (N,) or (N, width)."""
        rows = array.reshape(len(array), -1)
        accessor = {
            "bufferView": self.view(rows),
            "componentType": KINDS[rows.dtype.str[1:]],
            "count": len(rows),
            "type": WIDTHS[rows.shape[1]],
        }
        self.header["accessors"].append(accessor | more)
        return len(self.header["accessors"]) - 1

    def glb(self) -> bytes:
        self.header.setdefault("buffers", [{"byteLength": len(self.binary)}])
        text = json.dumps(self.header).encode()
        text += b" " * (-len(text) % 4)
        chunks = struct.pack("<I4s", len(text), b"JSON") + text
        chunks += struct.pack("<I4s", len(self.binary), b"BIN\0") + self.binary
        return b"glTF" + struct.pack("<II", 2, 12 + len(chunks)) + chunks
