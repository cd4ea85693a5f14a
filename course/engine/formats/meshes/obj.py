"""OBJ bytes to a `FilePart`: v, vt, vn and f, the smoothing groups of s, and the names of usemtl.

The format: Wavefront, "Object Files (.obj)", appendix B1 of the Advanced Visualizer's manual.

This is code of our own because a file is to be read as it is written, or refused with its line. trimesh 5.2 loses
triangles where a face of six corners without uv follows one of three with uv, and all normals where only some faces
have them; tinyobjloader 2.0rc13 takes the next corner's vertex for the normal of `f 1/1/ 2/2/ 3/3/`, and a word in a
vertex for 0; meshio 5.3 misreads numbers that count back, and refuses uv of another number than the vertices'.
"""

import codecs
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from typing import Final

import numpy as np

from course.base.inputs import INVISIBLE, text_of
from course.engine.core.types import Floats64, Indices, Mask
from course.engine.formats.meshes.obj_corners import KINDS, Corners, Face, corners_of
from course.engine.formats.meshes.parts import (
    FilePart,
    behind,
    doubtful,
    no_surface,
    numbers,
    real,
    same,
    surfaces,
    whole,
)
from course.engine.formats.meshes.polygons import cut
from course.engine.formats.meshes.twofold import one_sided

WIDTHS = {"v": 3, "vt": 2, "vn": 3}
"""How many numbers of a row are read; there may be more: colours or a weight behind a place, a third uv."""

Marks = Sequence[tuple[str, int, int]]
"""What follows a keyword, the number of its line, and how many faces stand before it."""

FORMS = {"v": "x y z", "vt": "u v", "vn": "x y z"}


NAMING: Final = frozenset(("o", "g", "mtllib", "mg", "lod", "bevel", "c_interp", "d_interp"))
"""What gives names, or says how a program is to show what is there; mtllib's colours are those of usemtl's names."""

MARKS: Final = frozenset(("s", "usemtl"))
"""What holds for the faces that follow."""

OUTLINES: Final = frozenset(("p", "l"))

_CURVES = "vp cstype deg bmat step curv curv2 surf parm trim hole scrv sp end con"
_OLD_CURVES = "bsp bzp cdc cdp res stech ctech"
CURVED: Final = frozenset(f"{_CURVES} {_OLD_CURVES}".split(" "))
"""Statements of free-form curves and surfaces, some of them of the format before 3.0."""


_LATIN: Final = "course.latin-1"
"""The way in which bytes are read that are no UTF-8: in names of older programs they are Latin-1."""


def _as_latin(error: UnicodeError) -> tuple[str, int]:
    if not isinstance(error, UnicodeDecodeError):
        raise error
    return error.object[error.start : error.end].decode("latin-1"), error.end


codecs.register_error(_LATIN, _as_latin)

_COMMENT = re.compile(r"(?<!\S)#.*")
"""It begins where a word does: 1.#INF, as Windows wrote it, is no number, and a#b is a name."""


@dataclass
class _Lines:
    """What of each kind stands in a file, and in which lines, from 1.

    Attributes
    ----------
    rows : keyword -> what follows it, by line
    numbers : keyword -> the lines
    marks : keyword -> what follows it, the number of its line and how many faces stand before it
    passed : keyword -> the lines of what isn't read
    """

    rows: dict[str, list[str]] = field(default_factory=lambda: {kind: [] for kind in KINDS})
    numbers: dict[str, list[int]] = field(default_factory=lambda: {kind: [] for kind in KINDS})
    faces: list[Face] = field(default_factory=list)
    marks: dict[str, list[tuple[str, int, int]]] = field(
        default_factory=lambda: {mark: [] for mark in MARKS}
    )
    passed: dict[str, list[int]] = field(default_factory=dict)

    def add(self, lines: Iterable[str], first: int) -> None:
        """Take lines without comments and indents; ``first``: the number of the first of them."""
        rows, numbers_of = self.rows, self.numbers
        for number, line in enumerate(lines, start=first):
            keyword, _, rest = line.partition(" ")
            if keyword in WIDTHS:
                rows[keyword].append(rest)
                numbers_of[keyword].append(number)
            elif keyword == "f":
                so_far = tuple(len(rows[kind]) for kind in KINDS) if "-" in rest else None
                self.faces.append(Face(number, rest, so_far))
            elif line:
                self._add_other(line, number)

    def _add_other(self, line: str, number: int) -> None:
        keyword, *rest = line.lstrip(INVISIBLE).split(None, 1) or [""]
        text = rest[0] if rest else ""
        if keyword in MARKS:
            self.marks[keyword].append((text, number, len(self.faces)))
        elif keyword in WIDTHS or keyword in ("f", "fo"):
            # After another space than one, behind what nobody sees, or as the format had faces before 3.0.
            plain = f"{'f' if keyword == 'fo' else keyword} {text}"
            if plain != line:
                self.add([plain], number)
        elif keyword and keyword not in NAMING:
            self.passed.setdefault(keyword, []).append(number)


def parse_obj(data: bytes) -> list[FilePart]:
    """Return the mesh of an OBJ file, its polygons cut into triangles: one part, whatever its groups and materials.

    Vertices are parted where faces give them several uv or normals, and where smoothing groups end. Corners without uv,
    in a file where others have it, are at (0, 0); those without a normal have zeros in its place.
    Raises ValueError, IndexError naming the line: for a row of too few numbers, or a word that is none; for a face
    without corners, whose corners differ in form, or that refers to what isn't there, or to a vertex or
    uv that isn't finite; for an s without a number.
    """
    lines = _Lines()
    lines.add(_plain_lines(text_of(data, _LATIN)), 1)
    v, vt, vn = (_numbers(kind, lines.rows[kind], lines.numbers[kind]) for kind in KINDS)
    notes = _passed(lines)
    if not lines.faces:
        if notes:
            raise ValueError(f"no triangles: {'; '.join(notes)}")
        return []
    lengths, corners = corners_of(lines.faces, (len(v), len(vt), len(vn)))
    face = np.arange(len(lengths))
    if (filled := surfaces(lengths)) is not None:
        kept, chosen = filled
        notes += no_surface([f"line {lines.faces[k].line}: a face" for k in np.flatnonzero(~kept)])
        lengths, face = lengths[kept], face[kept]
        corners = _chosen(corners, chosen)
        if not kept.any():
            raise ValueError(f"no triangles: {'; '.join(notes)}")
    for kind, rows, which in zip(KINDS[:2], (v, vt), corners[:2], strict=True):
        _check_finite(lines, kind, rows, which)
    if corners[2] is None and (once := one_sided(lengths, corners[0])) is not None:
        kept, chosen = once
        notes += behind(len(lengths) - int(kept.sum()), len(lengths))
        lengths, face = lengths[kept], face[kept]
        corners = _chosen(corners, chosen)
    cuts = cut(lengths, corners[0], v)
    notes += doubtful([f"line {lines.faces[k].line}: a face" for k in face[cuts.doubtful]])
    names, name = _named(lines.marks["usemtl"], len(lines.faces))
    groups = _groups(lines.marks["s"], len(lines.faces))
    group = None if groups is None else np.repeat(groups[face], lengths)
    return [
        replace(
            _part((v, vt, vn), corners, cuts.where, group),
            names=names,
            bare=_bare(corners[1], cuts.where),
            name=None if name is None else np.repeat(np.array(name)[face], lengths - 2),
            notes=notes,
        )
    ]


def _chosen(corners: Corners, which: Indices) -> Corners:
    vertex, *others = corners
    at, toward = (None if each is None else each[which] for each in others)
    return vertex[which], at, toward


def _bare(at: Indices | None, where: Indices) -> Mask | None:
    """Which triangles have no uv, though others have: a face has it at all corners or at none."""
    bare = None if at is None else at[where[:, 0]] < 0
    return bare if bare is not None and bare.any() else None


def _part(
    rows: tuple[Floats64, Floats64, Floats64],
    corners: Corners,
    where: Indices,
    group: Indices | None,
) -> FilePart:
    """Vertices and triangles; ``group``: of each corner the smoothing group, None where there are none at all."""
    (v, vt, vn), (vertex, at, toward) = rows, corners
    if toward is not None and group is not None:
        group = np.where(toward >= 0, 0, group)
    flat = toward is None and group is not None and bool((group < 0).all())
    group = None if flat else group
    if at is None and toward is None and group is None:
        return FilePart(v, vertex[where], None, None, flat=flat)
    columns = [each for each in (*corners, group) if each is not None]
    first, corner = same(*columns)
    return FilePart(
        vertices=v[vertex[first]],
        triangles=corner[where],
        normals=_rows_or_zeros(vn, toward, first),
        uv=_rows_or_zeros(vt, at, first),
        # A seam of the uv parts no normals.
        shared=None if group is None else same(vertex[first], group[first])[1],
        flat=flat,
    )


def _groups(marks: Marks, faces: int) -> Indices | None:
    """The smoothing group of each face, one of its own where smoothing is off; None where no s is in the file."""
    if not marks:
        return None
    # By the format it is off until it is switched on.
    groups = -1 - np.arange(faces)
    for (text, line, start), end in zip(marks, [*(m[2] for m in marks[1:]), faces], strict=True):
        word = text.strip()
        try:
            number = {"off": 0, "on": 1}.get(word.lower())
            number = whole(word) if number is None else number
        except ValueError:
            raise ValueError(f"line {line}: s {word[:40]!r}: expected a number, or off") from None
        if number:
            groups[start:end] = min(abs(number), 1 << 62)
    return groups


def _named(marks: Marks, faces: int) -> tuple[tuple[str, ...], list[int] | None]:
    """Names of materials that faces have, "" for none, and whose number each face has."""
    if not marks:
        return (), None
    numbers: dict[str, int] = {}
    found: list[int] = []
    spans = [("", 0, 0), *marks]
    for (text, _, start), end in zip(spans, [*(m[2] for m in marks), faces], strict=True):
        if end > start:
            found += [numbers.setdefault(text.strip(), len(numbers))] * (end - start)
    return tuple(numbers), found


def _passed(lines: _Lines) -> tuple[str, ...]:
    """What is told of statements that aren't read."""
    notes = []
    curved = sorted(CURVED.intersection(lines.passed))
    if curved:
        notes.append(
            f"line {lines.passed[curved[0]][0]}: free-form curves and surfaces ({', '.join(curved)}) are left out;"
            " export it as polygons"
        )
    if outlines := [line for kind in OUTLINES for line in lines.passed.get(kind, ())]:
        notes.append(
            f"line {min(outlines)}: points and lines have no surface, and are left out: {len(outlines):,}"
        )
    other = {k: at for k, at in lines.passed.items() if k not in CURVED and k not in OUTLINES}
    if other:
        word, at = min(other.items(), key=lambda item: item[1][0])
        more = sum(map(len, other.values())) - 1
        notes.append(
            f"line {at[0]}: {word[:40]!r} is no statement of a mesh, and was passed over"
            + (f", with {more:,} more such lines" if more else "")
        )
    longer = next((k for k, row in enumerate(lines.rows["v"]) if row.count(" ") > 3), None)
    if longer is not None and len(lines.rows["v"][longer].split()) > 4:
        notes.append(
            f"line {lines.numbers['v'][longer]}: numbers behind x y z, such as colours of vertices, are left out;"
            " the object's material says what colour it has"
        )
    return tuple(notes)


def _rows_or_zeros(rows: Floats64, index: Indices | None, which: Indices) -> Floats64 | None:
    """Those rows that some corners refer to; zeros where the index is -1."""
    if index is None:
        return None
    chosen = index[which]
    return np.where(chosen[:, None] < 0, 0.0, rows[chosen])


def _plain_lines(text: str) -> list[str]:
    """The lines without comments, tabs and indents; where one goes on in the next, that one is left empty."""
    text = text.replace("\r\n", "\n").replace("\r", "\n").replace("\t", " ")
    text = _COMMENT.sub("", text) if "#" in text else text
    lines = [line.strip() for line in text.split("\n")]
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


def _check_finite(lines: _Lines, kind: str, rows: Floats64, which: Indices | None) -> None:
    """Refuse rows that aren't finite and that a corner has, by their line."""
    odd = ~np.isfinite(rows).all(axis=1)
    if which is None or not odd.any():
        return
    wrong = np.intersect1d(which, np.flatnonzero(odd))
    if len(wrong):
        row, number = lines.rows[kind][wrong[0]], lines.numbers[kind][wrong[0]]
        raise ValueError(f"line {number}: {kind} {row.strip()[:60]}: expected finite numbers")


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
