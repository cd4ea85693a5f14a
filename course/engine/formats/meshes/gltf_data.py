"""Numbers of a glTF file: accessors in views of buffers, which lie in the file, in a URI or in a file beside it."""

from dataclasses import dataclass, field
from typing import Any, Final, TypeVar

import numpy as np
from numpy.typing import NDArray

from course.engine.core.types import Floats
from course.engine.formats.meshes.beside import Beside
from course.engine.formats.meshes.gltf_json import Accessor, Root

KINDS: Final = {5120: "i1", 5121: "u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
WIDTHS: Final = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}

Item = TypeVar("Item")


def item(items: list[Item], index: int, what: str) -> Item:
    """One of the items of a file; ValueError where there are fewer."""
    if index >= len(items):
        raise ValueError(f"it refers to {what} {index}, and has {len(items)}")
    return items[index]


@dataclass(frozen=True)
class Data:
    """A file's JSON, and what its numbers are read of.

    Attributes
    ----------
    binary : the file's own buffer, None where it has none
    """

    root: Root
    binary: memoryview | None
    beside: Beside
    _buffers: dict[int, bytes | memoryview] = field(default_factory=dict)

    def floats(self, index: int, *widths: int) -> Floats:
        """Numbers (N, width) of an accessor, as floats; integers as the share of their largest where it says so.

        ``widths``: those that are right
        """
        values, normalized = self.values(index, *widths)
        if values.dtype.kind == "f":
            return values
        if not normalized:
            return values.astype(np.float64)
        return np.maximum(values / np.iinfo(values.dtype).max, -1.0)

    def values(self, index: int, *widths: int) -> tuple[NDArray[Any], bool]:
        """Numbers (N, width) as the file has them, and whether they are shares of the largest."""
        accessor = item(self.root.accessors, index, "accessor")
        width = WIDTHS.get(accessor.type)
        if width not in widths or accessor.componentType not in KINDS:
            raise ValueError(
                f"accessor {index} is {accessor.type[:20]} of {accessor.componentType}: expected another type there"
            )
        kind = np.dtype(KINDS[accessor.componentType])
        return self._values(accessor, index, kind, width), accessor.normalized

    def _values(
        self, accessor: Accessor, index: int, kind: np.dtype[Any], width: int
    ) -> NDArray[Any]:
        shape = (accessor.count, width)
        if accessor.bufferView is not None:
            values = self._seen(accessor.bufferView, accessor.byteOffset, shape, kind, True)
        elif accessor.count * width * kind.itemsize > self.beside.bound.most:
            raise ValueError(
                f"accessor {index} has {accessor.count:,} rows of no data: too many{self.beside.bound.remedy}"
            )
        else:
            values = np.zeros(shape, kind)
        if accessor.sparse is not None:
            sparse = accessor.sparse
            of = np.dtype(KINDS.get(sparse.indices.componentType, "u1"))
            view, offset = sparse.indices.bufferView, sparse.indices.byteOffset
            where = self._seen(view, offset, (sparse.count, 1), of, False).ravel()
            view, offset = sparse.values.bufferView, sparse.values.byteOffset
            others = self._seen(view, offset, (sparse.count, width), kind, False)
            if where.size and int(where.max()) >= accessor.count:
                raise ValueError(
                    f"accessor {index} has values for a row {where.max()} that it hasn't"
                )
            values = values.copy()
            values[where] = others
        return values

    def _seen(
        self, view: int, offset: int, shape: tuple[int, int], kind: np.dtype[Any], strided: bool
    ) -> NDArray[Any]:
        found = item(self.root.bufferViews, view, "buffer view")
        if (
            any("meshopt" in name for name in found.extensions)
            and found.buffer not in self._buffers
        ):
            there = item(self.root.buffers, found.buffer, "buffer")
            if there.uri is None and found.buffer:
                raise ValueError(f"buffer view {view} is compressed; export it without compression")
        content = self._buffer(found.buffer)
        end = found.byteOffset + found.byteLength
        size = shape[1] * kind.itemsize
        stride = (found.byteStride if strided else None) or size
        needed = offset + max(0, shape[0] - 1) * stride + size * bool(shape[0])
        if end > len(content) or needed > found.byteLength or stride < size:
            raise ValueError(
                f"buffer view {view} ends at byte {end:,} of {len(content):,}, and {needed:,} bytes of it are wanted:"
                " it is cut short"
            )
        begin = found.byteOffset + offset
        return np.ndarray(shape, kind, content, begin, (stride, kind.itemsize))

    def _buffer(self, index: int) -> bytes | memoryview:
        if index not in self._buffers:
            buffer = item(self.root.buffers, index, "buffer")
            content: bytes | memoryview
            if buffer.uri is not None:
                content = self.beside.read(buffer.uri)
            elif index == 0 and self.binary is not None:
                content = self.binary
            else:
                raise ValueError(f"buffer {index} is neither in the file nor beside it")
            if len(content) < buffer.byteLength:
                raise ValueError(
                    f"buffer {index} has {len(content):,} bytes of {buffer.byteLength:,}: it is cut short"
                )
            self._buffers[index] = content
        return self._buffers[index]
