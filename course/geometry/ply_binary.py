"""The data of a binary PLY file by columns."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from course.geometry.mesh_polygons import Lists, runs, too_few
from course.geometry.ply_columns import Column, Columns
from course.geometry.ply_header import CORNERS, TYPES, Element, Header, Property


def binary_columns(header: Header, data: bytes) -> Columns:
    """Return the data of a binary PLY file, in either order of bytes.

    Raises
    ------
    ValueError
        For data of another length than announced, a face with fewer than three corners, and a list of fewer numbers
        than none.
    """
    at = header.end
    found: Columns = {}
    for element in header.elements:
        if element.rows:
            rows = _Rows(element, header, data, at)
            found[element.name], at = rows.even() or rows.uneven()
    if at != len(data):
        raise ValueError(_another_length(header, data))
    return found


def _another_length(header: Header, data: bytes) -> str:
    return (
        f"its {len(data) - header.end} bytes of data are an unexpected length:"
        " it is cut short, or a count in its header is wrong"
    )


@dataclass(frozen=True)
class _Rows:
    """The rows of an element, which begin at a byte of a file."""

    element: Element
    header: Header
    data: bytes
    at: int

    def _type(self, kind: str) -> np.dtype[np.generic]:
        return np.dtype(TYPES[kind]).newbyteorder("<" if "little" in self.header.order else ">")

    def even(self) -> tuple[dict[str, Column], int] | None:
        """Columns and where they end, if each list is as long as in the first row: the usual case, without a loop."""
        step = 0
        places: list[tuple[Property, int, int]] = []
        for each in self.element.properties:
            length = 1
            if each.count is not None:
                count = self._type(each.count)
                if self.at + step + count.itemsize > len(self.data):
                    return None
                length = int(np.frombuffer(self.data, count, 1, self.at + step)[0])
                if length < self._least(each):
                    return None
                step += count.itemsize
            places.append((each, step, length))
            step += length * self._type(each.kind).itemsize
        rows = self.element.rows
        if self.at + rows * step > len(self.data):
            return None
        found: dict[str, Column] = {}
        for each, place, length in places:
            kind = self._type(each.kind)
            start = self.at + place
            if each.count is None:
                found[each.name] = np.ndarray((rows,), kind, self.data, start, (step,))
                continue
            count = self._type(each.count)
            counts = np.ndarray((rows,), count, self.data, start - count.itemsize, (step,))
            if (counts != length).any():
                return None
            if length == 0:
                # The last row may end here, where no array can begin.
                values = np.zeros((rows, 0), kind)
            else:
                shape, strides = (rows, length), (step, kind.itemsize)
                values = np.ndarray(shape, kind, self.data, start, strides)
            found[each.name] = Lists(np.full(rows, length, np.int64), values.ravel())
        return found, self.at + rows * step

    def uneven(self) -> tuple[dict[str, Column], int]:
        """The same of any rows, which are looked at one after the other."""
        properties = self.element.properties
        shapes = [
            (
                self._type(each.kind).itemsize,
                None if each.count is None else self._type(each.count),
                self._least(each),
            )
            for each in properties
        ]
        order: str = "little" if "little" in self.header.order else "big"
        data, size, at = self.data, len(self.data), self.at
        starts, lengths = np.ones((2, len(properties), self.element.rows), np.int64)
        for row in range(self.element.rows):
            for k, (width, count, least) in enumerate(shapes):
                length = 1
                if count is not None:
                    end = at + count.itemsize
                    length = int.from_bytes(data[at:end], order, signed=count.kind == "i")  # type: ignore[arg-type]
                    if end > size:
                        raise ValueError(_another_length(self.header, data))
                    if length < least:
                        raise ValueError(self._trouble(properties[k], row, length))
                    at = end
                if at + length * width > size:
                    raise ValueError(_another_length(self.header, data))
                starts[k, row], lengths[k, row] = at, length
                at += length * width
        content = np.frombuffer(data, np.uint8, at - self.at, self.at)
        found: dict[str, Column] = {}
        for each, start, length, (width, *_) in zip(
            properties, starts, lengths, shapes, strict=True
        ):
            values = runs(content, start - self.at, length * width).view(self._type(each.kind))
            found[each.name] = values if each.count is None else Lists(length, values)
        return found, at

    def _least(self, each: Property) -> int:
        """How many numbers a list must have."""
        return 3 if self.element.name == "face" and each.name in CORNERS else 0

    def _trouble(self, each: Property, row: int, length: int) -> str:
        if self._least(each):
            return too_few(f"face {row}", length)
        return f"the list {each.name} of {self.element.name} {row} has {length} numbers: expected 0 or more"
