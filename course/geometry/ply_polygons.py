"""Faces of binary PLY files that mix triangles with other polygons, written anew as triangles alone."""

from __future__ import annotations

import re

import numpy as np
from numpy.typing import NDArray

from course.geometry.ply_header import SIZES
from course.geometry.ply_lines import too_few

_FACE = re.compile(rb"element +face +(\d+)\r?\n((?:property [^\n]*\n)+)")
_LIST = re.compile(r"list +(\w+) +(\w+) +vertex_ind(?:ex|ices)")


def fanned(data: bytes) -> bytes:
    """Return a PLY file with polygons of several lengths cut into fans of triangles; any other file as it is.

    A polygon 0 1 2 3 becomes 0 1 2 and 0 2 3, in its place. Whatever else a face has is left out. A file whose faces
    have other lists, or that is cut short, comes back as it is.

    Parameters
    ----------
    data : with the header that `course.geometry.ply_header.Header.text` writes

    Raises
    ------
    ValueError
        For a face with fewer than three corners.
    """
    end = re.search(rb"end_header\r?\n", data)
    order = re.search(rb"format +binary_(little|big)_endian", data[: end.start() if end else 0])
    if end is None or order is None:
        return data
    header = data[: end.end()]
    face = _FACE.search(header)
    if face is None:
        return data
    sign = "<" if order[1] == b"little" else ">"
    before = _stride(header[: face.start()], sign)
    rows = _Rows.of(face[2].decode("ascii", "replace"), sign)
    if before is None or rows is None:
        return data
    first = end.end() + before
    if rows.alike(data, first, int(face[1])):
        return data
    found = rows.find(data, first, int(face[1]))
    if found is None:
        return data
    count, start, last = found
    triangles = rows.triangles(data, count, start).astype(f"{sign}i4")
    written = np.empty(len(triangles), np.dtype([("n", "u1"), ("corners", f"{sign}i4", 3)]))
    written["n"] = 3
    written["corners"] = triangles
    new = f"element face {len(triangles)}\nproperty list uchar int vertex_indices\n".encode()
    return b"".join(
        (
            *(header[: face.start()], new, header[face.end() :]),
            *(data[end.end() : first], written.tobytes(), data[last:]),
        )
    )


def _stride(header: bytes, sign: str) -> int | None:
    """Bytes of all elements of a header; None where one has a list, or a type that isn't known."""
    total = 0
    for count, properties in re.findall(
        r"element +\w+ +(\d+)\r?\n((?:property [^\n]*\n)*)", header.decode("ascii", "replace")
    ):
        kinds = [line.split()[1] for line in properties.splitlines()]
        if not all(kind in SIZES for kind in kinds):
            return None
        total += int(count) * sum(np.dtype(sign + SIZES[kind]).itemsize for kind in kinds)
    return total


class _Rows:
    """Where the numbers of a face stand: some bytes, a list of vertices, and some bytes again."""

    def __init__(self, before: int, count: str, index: str, after: int) -> None:
        self.before, self.after = before, after
        self.count, self.index = np.dtype(count), np.dtype(index)

    @classmethod
    def of(cls, properties: str, sign: str) -> _Rows | None:
        """None where there is no list of vertices, or another list beside it."""
        sizes = [0, 0]
        types: tuple[str, str] | None = None
        for line in properties.splitlines():
            kind = line.removeprefix("property").strip()
            found = _LIST.fullmatch(kind)
            if found is not None and types is None:
                types = found[1], found[2]
            elif (one := kind.split()[0]) in SIZES:
                sizes[types is not None] += np.dtype(SIZES[one]).itemsize
            else:
                return None
        if types is None or not all(SIZES.get(each, "f")[0] in "iu" for each in types):
            return None
        count, index = (sign + SIZES[each] for each in types)
        return cls(sizes[0], count, index, sizes[1])

    def alike(self, data: bytes, first: int, faces: int) -> bool:
        """Whether all faces have as many corners as the first one; the usual case, found without a loop."""
        at = first + self.before
        if faces == 0 or at + self.count.itemsize > len(data):
            return True
        corners = int(np.frombuffer(data, self.count, 1, at)[0])
        if corners < 3:
            raise ValueError(too_few(0, corners))
        step = self.before + self.count.itemsize + corners * self.index.itemsize + self.after
        if first + faces * step > len(data):
            return False
        counts = np.ndarray((faces,), self.count, data, at, (step,))
        return bool((counts == corners).all())

    def find(
        self, data: bytes, first: int, faces: int
    ) -> tuple[NDArray[np.int64], NDArray[np.int64], int] | None:
        """Corners of each face, where they stand, and where the faces end; None for a file that is cut short."""
        each, width, size = self.count.itemsize, self.index.itemsize, len(data)
        order = "little" if self.count.str[0] in "<|" else "big"
        signed = self.count.kind == "i"
        # A face takes a byte or more.
        if faces > size:
            return None
        count, start = np.zeros((2, faces), np.int64)
        at = first
        for number in range(faces):
            at += self.before
            n = int.from_bytes(data[at : at + each], order, signed=signed)  # type: ignore[arg-type]
            count[number], start[number] = n, at + each
            if at + each > size:
                return None
            if n < 3:
                raise ValueError(too_few(number, n))
            at += each + n * width + self.after
            if at > size:
                return None
        return count, start, at

    def triangles(
        self, data: bytes, count: NDArray[np.int64], start: NDArray[np.int64]
    ) -> NDArray[np.int64]:
        """(T, 3), in the order of the faces."""
        content = np.frombuffer(data, np.uint8)
        found, faces = [], []
        for n in np.unique(count):
            which = np.flatnonzero(count == n)
            places = start[which][:, None] + np.arange(n * self.index.itemsize)
            corners = np.ascontiguousarray(content[places]).view(self.index).astype(np.int64)
            for k in range(1, n - 1):
                found.append(corners[:, [0, k, k + 1]])
                faces.append(which)
        # Stable: the triangles of a face stay in order.
        return np.concatenate(found)[np.argsort(np.concatenate(faces), kind="stable")]
