"""OBJ bytes to a `Part`: v, vt, vn and f; materials, groups, lines and curves are not looked at.

The format: Wavefront, "Object Files (.obj)", appendix B1 of the Advanced Visualizer's manual.

This is code of our own because a file is to be read as it is written, or refused with its line. trimesh 5.2 loses
triangles where a face of six corners without uv follows one of three with uv, and all normals where only some faces
have them; tinyobjloader 2.0rc13 takes the next corner's vertex for the normal of `f 1/1/ 2/2/ 3/3/`, and a word in a
vertex for 0; meshio 5.3 misreads numbers that count back, and refuses uv of another number than the vertices'.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from course.core.types import Floats64, Indices
from course.formats.meshes.formats import Part
from course.formats.meshes.obj_faces import KINDS, Face, corners_of
from course.formats.meshes.polygons import fans
from course.formats.meshes.welding import same
from course.formats.meshes.words import numbers, real

WIDTHS = {"v": 3, "vt": 2, "vn": 3}
"""How many numbers of a row are read; there may be more: colours or a weight behind a place, a third uv."""

FORMS = {"v": "x y z", "vt": "u v", "vn": "x y z"}


@dataclass
class _Lines:
    """What of each kind stands in a file, and in which lines, from 1.

    Attributes
    ----------
    rows : keyword -> what follows it, by line
    numbers : keyword -> the lines
    """

    rows: dict[str, list[str]] = field(default_factory=lambda: {kind: [] for kind in KINDS})
    numbers: dict[str, list[int]] = field(default_factory=lambda: {kind: [] for kind in KINDS})
    faces: list[Face] = field(default_factory=list)


def parse_obj(data: bytes) -> list[Part]:
    """Return the mesh of an OBJ file, its polygons cut into fans: one part, whatever its groups and materials.

    Vertices are parted where faces give them several uv or normals. Corners without uv, in a file where others have it,
    are at (0, 0); those without a normal have zeros in its place.

    Raises
    ------
    ValueError, IndexError
        Naming the line: for a row of too few numbers, or a word that is none; for a face of fewer than three corners,
        whose corners differ in form, or that refers to what isn't there.
    """
    lines = _Lines()
    for number, line in enumerate(_plain_lines(data.decode("utf-8", "replace")), start=1):
        keyword, _, rest = line.partition(" ")
        if keyword in WIDTHS:
            lines.rows[keyword].append(rest)
            lines.numbers[keyword].append(number)
        elif keyword == "f":
            so_far = tuple(len(lines.rows[kind]) for kind in KINDS) if "-" in rest else None
            lines.faces.append(Face(number, rest, so_far))
    v, vt, vn = (_numbers(kind, lines.rows[kind], lines.numbers[kind]) for kind in KINDS)
    if not lines.faces:
        return []
    lengths, corners = corners_of(lines.faces, (len(v), len(vt), len(vn)))
    where = fans(lengths)
    vertex, at, toward = corners
    if at is None and toward is None:
        return [Part(v, vertex[where], None, None, np.eye(4))]
    first, corner = same(*(each for each in corners if each is not None))
    return [
        Part(
            vertices=v[vertex[first]],
            triangles=corner[where],
            normals=_rows_or_zeros(vn, toward, first),
            uv=_rows_or_zeros(vt, at, first),
            transform=np.eye(4),
        )
    ]


def _rows_or_zeros(rows: Floats64, index: Indices | None, which: Indices) -> Floats64 | None:
    """Those rows that some corners refer to; zeros where the index is -1."""
    if index is None:
        return None
    chosen = index[which]
    return np.where(chosen[:, None] < 0, 0.0, rows[chosen])


def _plain_lines(text: str) -> list[str]:
    """The lines without comments, tabs and indents; where one goes on in the next, that one is left empty."""
    text = text.replace("\r\n", "\n").replace("\r", "\n").replace("\t", " ")
    lines = [line.partition("#")[0].strip() for line in text.split("\n")]
    if "\\" in text:
        for k in range(len(lines) - 1, -1, -1):
            if lines[k].endswith("\\"):
                after = lines[k + 1] if k + 1 < len(lines) else ""
                lines[k : k + 2] = [f"{lines[k][:-1]} {after}", ""]
    return lines


def _numbers(keyword: str, rows: list[str], lines: list[int]) -> Floats64:
    """(N, width) of the rows of one kind."""
    width = WIDTHS[keyword]
    if not rows:
        return np.zeros((0, width))
    words = len(rows[0].split())
    if words >= width:
        found = numbers(" ".join(rows))
        # A row that is longer could make up for one that is shorter.
        if len(found) == words * len(rows) and all(len(row.split()) == words for row in rows):
            return found.reshape(-1, words)[:, :width]
    return np.array([_row(keyword, row, number) for row, number in zip(rows, lines, strict=True)])


def _row(keyword: str, row: str, number: int) -> list[float]:
    words = row.split()
    values = []
    for word in words:
        try:
            values.append(real(word))
        except ValueError:
            raise ValueError(f"line {number}: {word[:40]!r} is no number") from None
    width = WIDTHS[keyword]
    if keyword == "vt" and len(values) == 1:
        # A texture of one dimension.
        values.append(0.0)
    if len(values) < width:
        raise ValueError(
            f"line {number}: {len(values)} numbers after {keyword}: expected {width}, {FORMS[keyword]}"
        )
    return values[:width]
