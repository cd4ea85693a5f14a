"""STL bytes to a `FilePart`: binary, and text in its variants.

This is code of our own because a file is to be read as it is written, or refused with its line. trimesh 5.2 finds no
triangles in a file that ends in "end solid", and none in a binary one with bytes behind its last triangle.

The format: 3D Systems, "StereoLithography interface specification", 1989; words with a space in them as later programs
write them.
"""

import re

import numpy as np
from numpy.typing import NDArray

from course.base.inputs import text_of, without_marks
from course.engine.core.types import Floats64
from course.engine.formats.meshes.parts import FilePart, numbers, real

HEADER = 84
"""Bytes before the first triangle: 80 of any text, and how many triangles there are."""

TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("more", "<u2")])

COLOURED = 1 << 15
"""Of the last two bytes of a triangle: the other bits are its colour, as VisCAM and SolidView write it."""

_COLOURS = "its colours are left out; the object's material says what colour it has"

_WORDS = re.compile(
    r"(?i)(?<!^)[ \t]+(?=(?:facet +normal|outer +loop|vertex|end *loop|end *facet|end *solid)\b)",
    re.M,
)
"""Where a line of a file ends that has several statements in a line."""

OTHERS = ("outer", "endloop", "endfacet", "endsolid", "solid", "end")
"""First words of lines that hold no numbers to read."""

LARGEST_INDENT = 512
"""Bytes in which a text says that it is one."""


def parse_stl(data: bytes) -> list[FilePart]:
    """Return the solids of an STL file as one part, each triangle with vertices of its own.

    Raises ValueError for a file that is cut short, and naming the line for a word that is no number, a statement that
    STL hasn't, and a facet that isn't of three vertices.
    """
    plain = without_marks(data, "replace")
    is_text = re.match(rb"(?i)\s*solid\b", plain) is not None and not _fits(data)
    if is_text and (b"facet" in plain[: 1 << 16].lower() or len(plain) < HEADER):
        return _text(text_of(plain, "replace"))
    return _binary(data)


def _count(data: bytes) -> int:
    return int.from_bytes(data[80:HEADER], "little")


def _fits(data: bytes) -> bool:
    """Whether a file is as long as a binary one that begins as it does; some of these begin with solid, too."""
    return len(data) >= HEADER and len(data) == HEADER + TRIANGLE.itemsize * _count(data)


def _binary(data: bytes) -> list[FilePart]:
    count, there = _count(data), (len(data) - HEADER) // TRIANGLE.itemsize
    if len(data) < HEADER or there < count:
        raise ValueError(
            f"it has {len(data):,} bytes, and its {count:,} triangles need {HEADER + count * TRIANGLE.itemsize:,}:"
            " it is cut short, or no STL"
        )
    notes = []
    if behind := len(data) - HEADER - count * TRIANGLE.itemsize:
        notes.append(f"{behind:,} bytes behind its last triangle are left out")
    rows = np.frombuffer(data, TRIANGLE, count, HEADER)
    if b"COLOR=" in data[:80] or (rows["more"] & COLOURED).any():
        notes.append(_COLOURS)
    return _parts(rows["corners"].reshape(-1, 3), rows["normal"], notes)


def _parts(
    corners: NDArray[np.floating], normals: NDArray[np.floating], notes: list[str]
) -> list[FilePart]:
    if not len(corners):
        return []
    triangles = np.arange(len(corners)).reshape(-1, 3)
    return [FilePart(corners, triangles, None, None, facets=normals, notes=tuple(notes))]


def _text(text: str) -> list[FilePart]:
    lines = text.splitlines()
    if len(lines) < len(re.findall(r"(?i)\bvertex\b", text)):
        lines = _WORDS.sub("\n", text).splitlines()
    vertices: list[str] = []
    normals: list[str] = []
    at: list[int] = []
    in_facet, coloured = 3, False
    for number, line in enumerate(lines, start=1):
        words = line.split(None, 1)
        if not words or words[0].startswith("#"):
            continue
        keyword = words[0].lower()
        if keyword == "vertex":
            in_facet += 1
            vertices.append(line)
            at.append(number)
        elif keyword == "facet":
            if in_facet != 3:
                raise ValueError(f"line {number}: {_not_three(in_facet)}")
            in_facet = 0
            normals.append(line)
        elif keyword == "color":
            coloured = True
        elif keyword not in OTHERS:
            raise ValueError(f"line {number}: {words[0][:40]!r} begins no line of an STL file")
        elif keyword == "endfacet" and in_facet != 3:
            raise ValueError(f"line {number}: {_not_three(in_facet)}")
    if in_facet != 3 or len(vertices) != 3 * len(normals):
        raise ValueError(f"line {len(lines)}: {_not_three(in_facet)}")
    corners = _numbers(vertices, 1, at)
    facets = _numbers(normals, 2, None)
    return _parts(corners, facets, [_COLOURS] if coloured else [])


def _not_three(count: int) -> str:
    return f"a facet of {count} vertices ends: expected 3; it is cut short, or no mesh of triangles"


def _numbers(rows: list[str], words: int, at: list[int] | None) -> Floats64:
    """The three numbers (N, 3) of each line, behind so many words; ``at``: lines that are told; None for no numbers."""
    parts = [row.split() for row in rows]
    if all(len(each) == words + 3 for each in parts):
        found = numbers(" ".join(" ".join(each[words:]) for each in parts))
        if len(found) == 3 * len(rows):
            return found.reshape(-1, 3)
    # What facets say may be wrong: then nothing is known of their sides.
    if at is None:
        return np.zeros((len(rows), 3))
    for each, line in zip(parts, at, strict=True):
        if len(each) < words + 3:
            raise ValueError(
                f"line {line}: {len(each) - words} numbers after vertex: expected 3, x y z"
            )
        for word in each[words : words + 3]:
            _check(word, line)
    return np.array([[real(word) for word in each[words : words + 3]] for each in parts])


def _check(word: str, line: int) -> None:
    try:
        real(word)
    except ValueError:
        comma = (
            "; write decimals with a point" if re.fullmatch(r"[-+\d.]*,[\d.eE+-]*", word) else ""
        )
        raise ValueError(f"line {line}: {word[:40]!r} is no number{comma}") from None
