"""PLY bytes to a `FilePart`: the header, its elements' rows as columns of numbers, and the mesh that these are.

This is code of our own because a file is to be read as it is written, or refused with its line. trimesh 5.2 failed
on 31 of 80 right files in `tests/engine/formats/meshes/test_broken_ply.py` and `test_ply_elements.py`, such as faces
with uv in text. Of 66 wrong ones it read 33, such as lines of too few numbers; where it refuses one, it names no line.

The format: Greg Turk, "The PLY polygon file format", 1994; types as later programs write them.
"""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray

from course.base.inputs import text_of, without_marks
from course.engine.formats.meshes.parts import (
    Array,
    FilePart,
    Lists,
    behind,
    doubtful,
    no_surface,
    numbers,
    real,
    runs,
    same,
    surfaces,
    too_few,
)
from course.engine.formats.meshes.polygons import cut
from course.engine.formats.meshes.twofold import one_sided

_NAMES = ("int8", "uint8", "int16", "uint16", "int32", "uint32", "float32", "float64")
_OLD = ("char", "uchar", "short", "ushort", "int", "uint", "float", "double")
_ADDED = ("int64", "uint64", "float16")
TYPES = dict(zip((*_OLD, *_NAMES, *_ADDED), (*_NAMES, *_NAMES, *_ADDED), strict=True))
"""Types of PLY, some programs' own among them, as NumPy calls them."""

ORDERS = ("ascii", "binary_little_endian", "binary_big_endian")

CORNERS = ("vertex_indices", "vertex_index")
"""Names of a face's list of vertices."""

WEDGES = "texcoord"
"""Name of a face's list of uv, u and v for each of its corners."""

UV = tuple(
    tuple(pair.split())
    for pair in (
        *("texture_u texture_v", "u v", "s t", "texture_s texture_t", "texcoord_u texcoord_v"),
        *("u0 v0", "s0 t0", "tu tv"),
    )
)
"""Names that programs use for the uv of a vertex; the format defines none."""

COLORS = ("red", "diffuse_red", "r")
"""Names of the first property of colours."""

MOST_NAMES = 1000
"""Elements and properties that a header may have; usual ones have ten or twenty."""

LONGEST = 16 << 20
"""Bytes of a header."""

_END = re.compile(rb"^end_header[ \t]*(?:\r?\n|\Z)", re.MULTILINE)
_COUNT = re.compile(r"\d{1,30}")
_CUT_SHORT = "it is cut short, or a count in its header is wrong"


@dataclass(frozen=True)
class Property:
    """A number of each row, or with ``count``, the type of its length, a list of ``least`` or more numbers.

    Only a face's corners have a least number of them; other lists may be empty.
    """

    name: str
    kind: np.dtype[Any]
    count: np.dtype[Any] | None = None
    least: int = 0


@dataclass(frozen=True)
class PlyElement:
    """``rows`` things of one kind."""

    name: str
    rows: int
    properties: list[Property]

    def cut_short(self) -> ValueError:
        """The error of a file that ends too early."""
        return ValueError(f"it ends before its {self.rows} of element {self.name}: {_CUT_SHORT}")

    def too_short(self, row: int, each: Property, length: int) -> str:
        """The error of a list."""
        if each.least:
            return too_few(f"face {row}", length)
        return f"the list {each.name} of {self.name} {row} has {length} numbers: expected 0 or more"


Column: TypeAlias = NDArray[Any] | Lists
"""A property of N rows: (N,), or a list for each."""

Columns: TypeAlias = dict[str, Column]
"""By a property's name."""


def parse_ply(data: bytes) -> list[FilePart]:
    """Return the mesh of a PLY file, its polygons cut into triangles, with uv by vertex or by corner.

    Elements and properties of other names are left out. Faces whose list of uv is empty, while others have uv, are at
    (0, 0) with all corners.
    Raises ValueError for whatever is wrong with the header, a line or the length of the data, and for lists of uv that
    don't fit their faces.
    """
    data = without_marks(data, "replace")
    order, elements, end = _header(data)
    columns = dict((_text if order == "ascii" else _binary)(elements, data, end))
    vertex, face = columns.get("vertex", {}), columns.get("face", {})
    if not face:
        if "tristrips" in columns:
            raise ValueError(
                "its triangles are strips (element tristrips): write it anew with faces, such as by MeshLab"
            )
        return []
    corners, wedges = _lists(face)
    vertices = _stacked(vertex, tuple("xyz"))
    vertices = np.zeros((0, 3)) if vertices is None else vertices
    normals = _stacked(vertex, ("nx", "ny", "nz"))
    notes = tuple(
        f"{name} of its vertices and faces, such as colours, is left out; the object's material says what colour it has"
        for name in COLORS
        if name in vertex or name in face
    )[:1]
    lengths, values = corners.lengths, corners.values.astype(np.int64)
    numbers_of, chosen = np.arange(len(lengths)), np.arange(len(values))
    if (filled := surfaces(lengths)) is not None:
        kept, chosen = filled
        notes += no_surface([f"face {k}" for k in numbers_of[~kept]])
        numbers_of, lengths, values = numbers_of[kept], lengths[kept], values[chosen]
        if not kept.any():
            raise ValueError(f"no triangles: {'; '.join(notes)}")
    if normals is None and values.min() >= 0 and (once := one_sided(lengths, values)) is not None:
        kept, among = once
        notes += behind(len(lengths) - int(kept.sum()), len(lengths))
        numbers_of, lengths, values = numbers_of[kept], lengths[kept], values[among]
        chosen = chosen[among]
    cuts = cut(lengths, values, vertices)
    notes += doubtful([f"face {k}" for k in numbers_of[cuts.doubtful]])
    part = FilePart(
        vertices=vertices,
        triangles=values[cuts.where],
        normals=normals,
        uv=next((uv for names in UV if (uv := _stacked(vertex, names)) is not None), None),
        notes=notes,
    )
    if wedges is None or not wedges.lengths.any():
        return [part]
    uv = np.zeros((corners.lengths.sum(), 2), wedges.values.dtype)
    uv[np.repeat(wedges.lengths > 0, corners.lengths)] = wedges.values.reshape(-1, 2)
    without = np.repeat(wedges.lengths == 0, corners.lengths)
    uv, without = uv[chosen], without[chosen]
    bare = without[cuts.where[:, 0]]
    part = replace(part, bare=bare if bare.any() else None)
    return [_split_by_corner(part, uv[cuts.where.ravel()])]


def _lists(face: Columns) -> tuple[Lists, Lists | None]:
    """The faces' corners, and their uv where they have lists of these."""
    corners, wedges = next(face[name] for name in CORNERS if name in face), face.get(WEDGES)
    assert isinstance(corners, Lists), "the header has been checked"
    return corners, wedges if isinstance(wedges, Lists) else None


def _stacked(columns: Columns, names: tuple[str, ...]) -> Array | None:
    """(N, len(names)) of columns of plain numbers; None where one is missing."""
    plain = [each for name in names if isinstance(each := columns.get(name), np.ndarray)]
    return np.column_stack(plain) if len(plain) == len(names) else None


def _split_by_corner(part: FilePart, uv: Array) -> FilePart:
    """Return `part` with a vertex for each uv (3 T, 2) that its corners have."""
    vertex = part.triangles.ravel()
    first, corner = same(vertex, uv[:, 0], uv[:, 1])
    kept = vertex[first]
    if kept.min() < 0 or kept.max() >= len(part.vertices):
        return part  # the caller reports the index
    normals = None if part.normals is None else np.asarray(part.normals)[kept]
    triangles = corner.reshape(-1, 3)
    return replace(
        part, vertices=part.vertices[kept], triangles=triangles, normals=normals, uv=uv[first]
    )


# ---------------------------------------------------------------- header


def _header(data: bytes) -> tuple[str, list[PlyElement], int]:
    """One of ORDERS, the elements that have rows, and the byte at which their data begins; all checked."""
    if re.match(rb"(?i)ply\s", data) is None:
        raise ValueError("it doesn't begin with a line that says ply")
    end = _END.search(data, 0, LONGEST)
    if end is None:
        where = f" in the first {LONGEST >> 20} MB" if len(data) > LONGEST else ""
        raise ValueError(
            f"its header has no line end_header{where} (lines must end in LF or CR LF)"
        )
    lines = text_of(data[: end.start()], "replace").split("\n")[:-1]
    rows = [line.split() for line in lines]
    formats = [" ".join(words[1:2]) for words in rows if words[:1] == ["format"]]
    order = "".join(formats[:1])
    elements: list[PlyElement] = []
    names = 0
    for number, words in enumerate(rows[1:], start=2):
        # Messages list them.
        names += words[:1] in (["element"], ["property"])
        if names > MOST_NAMES:
            raise ValueError(
                f"line {number}: more than {MOST_NAMES} elements and properties: write it anew with those of a mesh"
            )
        try:
            match words:
                case [] | ["comment" | "obj_info", *_]:
                    pass
                # Names are repeated in messages.
                case _ if not all(word.isprintable() for word in words):
                    raise ValueError("expected printable characters")
                case ["format", *_] if order in ORDERS and len(formats) == 1:
                    pass
                case ["format", *_]:
                    raise ValueError(f"expected one format: {', '.join(ORDERS)}")
                case ["element", name, count] if _COUNT.fullmatch(count):
                    if any(name == other.name for other in elements):
                        raise ValueError(f"expected element {name} once")
                    elements.append(PlyElement(name, int(count), []))
                case ["element", *_]:
                    raise ValueError(
                        "expected a name and how many there are, such as element vertex 8"
                    )
                case ["property", *_] if not elements:
                    raise ValueError("expected an element before its properties")
                case ["property", *rest]:
                    elements[-1].properties.append(_property(rest, elements[-1], order))
                case _:
                    raise ValueError("expected format, comment, element or property")
        except ValueError as error:
            raise ValueError(
                f"line {number} is {lines[number - 1].strip()[:80]!r}: {error}"
            ) from None
    if not order:
        raise ValueError(f"its format is missing: expected one of {', '.join(ORDERS)}")
    elements = [each for each in elements if each.rows]
    size = len(data) - end.end()
    for each in elements:
        _check(each)
        # Before anything of that length is made. In text each number is a digit at least, and something after it, but
        # for the last one of all.
        least = (
            2 if order == "ascii" else (of.count or of.kind).itemsize for of in each.properties
        )
        size -= each.rows * sum(least)
        if size < (-1 if order == "ascii" else 0):
            raise each.cut_short()
    return order, elements, end.end()


def _property(words: list[str], element: PlyElement, order: str) -> Property:
    match words:
        case ["list", _, _, name] | [_, name] if words[:-1] != ["list"]:
            types = words[-3:-1]
        case _:
            raise ValueError(
                "expected such as property float x, or property list uchar int vertex_indices"
            )
    for word in types:
        if word not in TYPES:
            raise ValueError(
                f"{word[:40]!r} is no type of PLY: expected such as float, double, uchar, int"
            )
    sign: Literal["<", ">"] = ">" if order == ORDERS[2] else "<"
    *count, kind = (np.dtype(TYPES[word]).newbyteorder(sign) for word in types)
    if count and count[0].kind == "f":
        raise ValueError(f"how long a list is can't be a {types[0]}: expected such as uchar")
    if any(name == other.name for other in element.properties):
        raise ValueError(f"expected {name} once")
    if not count:
        return Property(name, kind)
    corners = element.name == "face" and name in CORNERS
    if corners and kind.kind == "f":
        raise ValueError(
            f"the corners of its faces are of type {types[1]}: expected whole numbers, such as int"
        )
    return Property(name, kind, count[0], 1 if corners else 0)


def _check(element: PlyElement) -> None:
    """Refuse what is no mesh; a face's only list is its corners, whatever its name."""
    properties = element.properties
    if not properties:
        raise ValueError(f"element {element.name} has no properties: leave it out of the header")
    if element.name == "vertex":
        plain = [each.name for each in properties if each.count is None]
        if missing := [axis for axis in "xyz" if axis not in plain]:
            found = (f"{'a list ' * (each.count is not None)}{each.name}" for each in properties)
            raise ValueError(
                f"its vertices have no {', '.join(missing)}: expected properties x, y and z, found {', '.join(found)}"
            )
    if element.name == "face":
        only = properties[0]
        if len(properties) == 1 and only.count is not None and only.kind.kind != "f":
            properties[0] = replace(only, name=CORNERS[0], least=1)
        if [each.least for each in properties if each.name in CORNERS] != [1]:
            raise ValueError(
                "its faces have no list of corners: expected property list uchar int vertex_indices"
            )


# ---------------------------------------------------------------- data


def _check_uv(element: PlyElement, columns: Columns, lines: Sequence[int] = ()) -> None:
    """Refuse faces that have uv for some of their corners; ``lines`` are those of the faces, in text."""
    of, uv = _lists(columns) if element.name == "face" else (None, None)
    if of is None or uv is None:
        return
    corners, wedges = of.lengths, uv.lengths
    wrong = (wedges != 0) & (wedges != 2 * corners)
    if wrong.any():
        k = int(np.argmax(wrong))
        raise ValueError(
            f"{f'line {lines[k]}: ' if lines else ''}{WEDGES} of face {k} has {wedges[k]} number"
            f"{'' if wedges[k] == 1 else 's'}: expected {2 * corners[k]}, u and v for each of its {corners[k]} corners,"
            " or 0 for a face without"
        )


def _text(elements: list[PlyElement], data: bytes, end: int) -> Iterator[tuple[str, Columns]]:
    """The columns of each element, by its name, of a file in text."""
    lines = text_of(data[end:], "replace").splitlines()
    first = data.count(b"\n", 0, end) + 1
    filled = [k for k, line in enumerate(lines) if line and not line.isspace()]
    for element in elements:
        rows, filled = filled[: element.rows], filled[element.rows :]
        if len(rows) < element.rows:
            raise element.cut_short()
        found = _text_columns(element, [lines[k] for k in rows])
        if found is None:
            for number, k in enumerate(rows):
                if trouble := _trouble(element, number, lines[k].split()):
                    raise ValueError(f"line {first + k}: {trouble}")
            raise ValueError("its numbers can't be read")
        _check_uv(element, found, [first + k for k in rows])
        yield element.name, found
    if filled:
        raise ValueError(f"line {first + filled[0]} is left over: a count in its header is wrong")


def _text_columns(element: PlyElement, lines: list[str]) -> Columns | None:
    """Columns of an element's lines, without a loop over these; None where something is wrong with one."""
    words = np.array([len(line.split()) for line in lines])
    values = numbers(" ".join(lines))
    if len(values) != words.sum():
        return None
    ends = np.cumsum(words)
    at = ends - words
    found: Columns = {}
    for each in element.properties:
        # What is announced as float has its precision; other numbers are as they are written.
        kind = each.kind if each.kind.kind == "f" else np.dtype(np.float64)
        if (at >= ends).any():
            return None
        if each.count is None:
            found[each.name] = values[at].astype(kind)
            at = at + 1
            continue
        lengths = values[at].astype(np.int64)
        wrong = (lengths != values[at]) | (lengths < each.least) | (lengths >= ends - at)
        if wrong.any():
            return None
        items = runs(values, at + 1, lengths)
        if each.least and (items % 1 != 0).any():
            return None
        found[each.name] = Lists(lengths, items.astype(kind))
        at = at + 1 + lengths
    return found if (at == ends).all() else None


def _trouble(element: PlyElement, row: int, words: list[str]) -> str | None:
    """The error of the words of a row."""
    at = 0
    for each in element.properties:
        length = 1
        if each.count is not None and at < len(words):
            try:
                length = _whole(words[at])
            except ValueError:
                return f"{words[at][:40]!r} is no count of numbers to come"
            if length < each.least:
                return element.too_short(row, each, length)
            at += 1
        for word in words[at : at + length]:
            try:
                _whole(word) if each.least else real(word)
            except ValueError:
                if each.least:
                    return f"corner {word[:40]!r} of face {row}: expected a whole number"
                return f"{word[:40]!r} is no number"
        at += length
    if at == len(words):
        return None
    form = (
        f"{'count ' * (each.count is not None)}{each.name}{'...' * (each.count is not None)}"
        for each in element.properties
    )
    return f"{len(words)} numbers for {element.name} {row}: expected {at}, {' '.join(form)}"


def _whole(word: str) -> int:
    if not real(word).is_integer():
        raise ValueError
    return int(real(word))


def _binary(elements: list[PlyElement], data: bytes, end: int) -> Iterator[tuple[str, Columns]]:
    """The same of a binary file, in either order of bytes."""
    unexpected = f"its {len(data) - end} bytes of data are an unexpected length: {_CUT_SHORT}"
    at = end
    for element in elements:
        rows = _even_rows(element, data, at) or _uneven_rows(element, data, at)
        if rows is None:
            raise ValueError(unexpected)
        columns, at = rows
        _check_uv(element, columns)
        yield element.name, columns
    if at != len(data):
        raise ValueError(unexpected)


def _even_rows(element: PlyElement, data: bytes, at: int) -> tuple[Columns, int] | None:
    """Columns and the byte at which they end, without a loop; None if not all lists are as long as the first row's."""
    fields: list[Any] = []
    step = 0
    for each in element.properties:
        length = 1
        if each.count is not None:
            if at + step + each.count.itemsize > len(data):
                return None
            length = int(np.frombuffer(data, each.count, 1, at + step)[0])
            if length < each.least:
                return None
            step += each.count.itemsize
            fields.append((f"length of {each.name}", each.count))
        fields.append((each.name, each.kind, () if each.count is None else (length,)))
        step += length * each.kind.itemsize
    end = at + element.rows * step
    # NumPy has no larger rows.
    if end > len(data) or step > 2**31 - 1:
        return None
    rows = np.frombuffer(data, np.dtype(fields), element.rows, at)
    found: Columns = {}
    for each in element.properties:
        found[each.name] = column = rows[each.name]
        if each.count is not None:
            lengths = rows[f"length of {each.name}"]
            if (lengths != lengths[0]).any():
                return None
            found[each.name] = Lists(np.full(len(rows), lengths[0], np.int64), column.ravel())
    return found, end


def _uneven_rows(element: PlyElement, data: bytes, at: int) -> tuple[Columns, int] | None:
    """The same of any rows, looked at one after the other; None if the data ends before they do."""
    begin, size = at, len(data)
    big = any(">" in (each.count or each.kind).str for each in element.properties)
    order: Literal["big", "little"] = "big" if big else "little"
    types = [
        (
            each.kind.itemsize,
            each.count and each.count.itemsize,
            "i" in (each.count or each.kind).kind,
        )
        for each in element.properties
    ]
    starts, lengths = np.ones((2, len(types), element.rows), np.int64)
    for row in range(element.rows):
        for k, (width, count, signed) in enumerate(types):
            length = 1
            if count is not None:
                start, at = at, at + count
                length = int.from_bytes(data[start:at], order, signed=signed)
                if at > size:
                    return None
                if length < (each := element.properties[k]).least:
                    raise ValueError(element.too_short(row, each, length))
            starts[k, row], lengths[k, row] = at - begin, length
            at += length * width
            if at > size:
                return None
    content = np.frombuffer(data, np.uint8, at - begin, begin)
    found: Columns = {}
    for each, start, length in zip(element.properties, starts, lengths, strict=True):
        values = runs(content, start, length * each.kind.itemsize).view(each.kind)
        found[each.name] = values if each.count is None else Lists(length, values)
    return found, at
