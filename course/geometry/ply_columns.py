"""The data of a PLY file by columns: of each element each property as one array."""

from __future__ import annotations

from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from course.geometry.mesh_polygons import Lists, runs
from course.geometry.mesh_words import numbers
from course.geometry.ply_header import TYPES, Element, Header
from course.geometry.ply_lines import checked_lines, word_that_is_no_number

Column: TypeAlias = NDArray[Any] | Lists
"""A property of N rows: (N,), or a list for each."""

Columns: TypeAlias = dict[str, dict[str, Column]]
"""From an element's name, and a property's, to its column; nothing of elements that have no rows."""


def text_columns(header: Header, data: bytes) -> Columns:
    """Return the data of a PLY file in text.

    Raises
    ------
    ValueError
        Naming the line: see `course.geometry.ply_lines.checked_lines`; and for a word that is no number.
    """
    return {
        element.name: _columns(element, lines, header, data)
        for element, lines in checked_lines(header, data)
        if lines
    }


def _columns(element: Element, lines: list[str], header: Header, data: bytes) -> dict[str, Column]:
    words = np.array([len(line.split()) for line in lines])
    values = numbers(" ".join(lines))
    if len(values) != words.sum():
        raise ValueError(word_that_is_no_number(header, data) or "its numbers can't be read")
    at = np.cumsum(words) - words
    found: dict[str, Column] = {}
    for each in element.properties:
        # What is announced as float has its precision; other numbers are as they are written.
        kind = np.dtype(np.float64 if each.whole else TYPES[each.kind])
        if each.count is None:
            found[each.name] = values[at].astype(kind)
            at = at + 1
            continue
        lengths = values[at].astype(np.int64)
        found[each.name] = Lists(lengths, runs(values, at + 1, lengths).astype(kind))
        at = at + 1 + lengths
    return found
