"""The header of a PLY file, checked before anything is read by it.

The format: Greg Turk, "The PLY polygon file format", 1994; types as later programs write them.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np

TYPES = {
    **dict.fromkeys(("char", "int8"), "i1"),
    **dict.fromkeys(("uchar", "uint8"), "u1"),
    **dict.fromkeys(("short", "int16"), "i2"),
    **dict.fromkeys(("ushort", "uint16"), "u2"),
    **dict.fromkeys(("int", "int32"), "i4"),
    **dict.fromkeys(("uint", "uint32"), "u4"),
    **dict.fromkeys(("float", "float32"), "f4"),
    **dict.fromkeys(("double", "float64"), "f8"),
    # Some programs add these.
    "int64": "i8",
    "uint64": "u8",
    "float16": "f2",
}
"""Types of PLY as NumPy calls them, without their byte order."""

ORDERS = ("ascii", "binary_little_endian", "binary_big_endian")

CORNERS = ("vertex_indices", "vertex_index")
"""Names of a face's list of vertices."""

WEDGES = "texcoord"
"""Name of a face's list of uv, u and v for each of its corners."""

MOST_NAMES = 1000
"""Elements and properties that a header may have; usual ones have ten or twenty."""

LONGEST = 16 << 20
"""Bytes of a header."""

_END = re.compile(rb"^end_header[ \t]*(?:\r?\n|\Z)", re.MULTILINE)
_COUNT = re.compile(r"\d{1,30}")


@dataclass(frozen=True)
class Property:
    """One number of each row of an element; or a list of them, where ``count`` is the type of its length, not None."""

    name: str
    kind: str
    count: str | None = None

    @property
    def least(self) -> int:
        """Bytes that it takes at least."""
        return np.dtype(TYPES[self.count or self.kind]).itemsize

    @property
    def whole(self) -> bool:
        """Whether it holds whole numbers."""
        return TYPES[self.kind][0] in "iu"


@dataclass(frozen=True)
class Element:
    """``rows`` things of one kind."""

    name: str
    rows: int
    properties: tuple[Property, ...]


@dataclass(frozen=True)
class Header:
    """What a PLY file says of itself.

    Attributes
    ----------
    order : one of ORDERS
    elements : in the order of the data
    lines : how many lines of the file it takes
    end : the byte at which the data begins
    """

    order: str
    elements: tuple[Element, ...]
    lines: int
    end: int


def read_header(data: bytes) -> Header:
    """Return the header of a PLY file.

    Raises
    ------
    ValueError
        Naming the line: for one that isn't known, a type or a count that isn't one, an element or a property twice or
        more than MOST_NAMES; and where vertices have no x, y or z, faces no list of corners, or the file is too short
        for what is announced.
    """
    if re.match(rb"(?i)ply\s", data) is None:
        raise ValueError("it doesn't begin with a line that says ply")
    end = _END.search(data, 0, LONGEST)
    if end is None:
        where = f" in the first {LONGEST >> 20} MB" if len(data) > LONGEST else ""
        raise ValueError(
            f"its header has no line end_header{where} (lines must end in LF or CR LF)"
        )
    lines = data[: end.start()].decode("ascii", "replace").split("\n")[:-1]
    order: str | None = None
    elements: list[Element] = []
    names = 0
    for number, line in enumerate(lines[1:], start=2):
        words = line.split()
        # Each name is looked for among the others, and messages list them.
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
                case ["format", given, *_] if given in ORDERS and order is None:
                    order = given
                case ["format", *_]:
                    raise ValueError(f"expected one format: {', '.join(ORDERS)}")
                case ["element", *rest]:
                    elements.append(_element(rest, elements))
                case ["property", *rest]:
                    elements[-1:] = [_with_property(rest, elements)]
                case _:
                    raise ValueError("expected format, comment, element or property")
        except ValueError as error:
            raise ValueError(f"line {number} is {line.strip()[:80]!r}: {error}") from None
    if order is None:
        raise ValueError(f"its format is missing: expected one of {', '.join(ORDERS)}")
    checked = tuple(map(_usable, elements))
    _check_length(checked, len(data) - end.end(), order)
    return Header(order, checked, len(lines) + 1, end.end())


def _element(words: list[str], others: list[Element]) -> Element:
    if len(words) != 2 or _COUNT.fullmatch(words[1]) is None:
        raise ValueError("expected a name and how many there are, such as element vertex 8")
    if any(other.name == words[0] for other in others):
        raise ValueError(f"expected element {words[0]} once")
    return Element(words[0], int(words[1]), ())


def _with_property(words: list[str], elements: list[Element]) -> Element:
    """The last element with one property more."""
    if not elements:
        raise ValueError("expected an element before its properties")
    match words:
        case ["list", count, kind, name]:
            found = Property(name, kind, count)
        case [kind, name] if kind != "list":
            found = Property(name, kind)
        case _:
            raise ValueError(
                "expected such as property float x, or property list uchar int vertex_indices"
            )
    for given in (found.kind, found.count):
        if given is not None and given not in TYPES:
            raise ValueError(
                f"{given[:40]!r} is no type of PLY: expected such as float, double, uchar, int"
            )
    if found.count is not None and TYPES[found.count][0] == "f":
        raise ValueError(f"how long a list is can't be a {found.count}: expected such as uchar")
    last = elements[-1]
    if any(other.name == found.name for other in last.properties):
        raise ValueError(f"expected {found.name} once")
    return Element(last.name, last.rows, (*last.properties, found))


def _usable(element: Element) -> Element:
    """An element with all that a mesh needs of it; a face's only list is its corners, whatever its name."""
    if element.rows == 0:
        return element
    if not element.properties:
        raise ValueError(f"element {element.name} has no properties: leave it out of the header")
    if element.name == "vertex":
        plain = {each.name for each in element.properties if each.count is None}
        missing = [axis for axis in "xyz" if axis not in plain]
        if missing:
            found = (
                each.name if each.count is None else f"a list {each.name}"
                for each in element.properties
            )
            raise ValueError(
                f"its vertices have no {', '.join(missing)}: expected properties x, y and z, found {', '.join(found)}"
            )
    if element.name == "face":
        if len(element.properties) == 1 and element.properties[0].count is not None:
            (only,) = element.properties
            element = Element("face", element.rows, (Property(CORNERS[0], only.kind, only.count),))
        corners = [each for each in element.properties if each.name in CORNERS]
        if len(corners) != 1 or corners[0].count is None:
            raise ValueError(
                "its faces have no list of corners: expected property list uchar int vertex_indices"
            )
        if not corners[0].whole:
            raise ValueError(
                f"the corners of its faces are of type {corners[0].kind}: expected whole numbers, such as int"
            )
    return element


def _check_length(elements: tuple[Element, ...], size: int, order: str) -> None:
    """Refuse counts that the file is too short for, before anything of that length is made."""
    for element in elements:
        # In text each number is a digit at least, and something after it, but for the last one of all.
        least = (2 if order == "ascii" else each.least for each in element.properties)
        size -= element.rows * sum(least)
        if size < (-1 if order == "ascii" else 0):
            raise ValueError(cut_short(element))


def cut_short(element: Element) -> str:
    """What is wrong with a file that ends too early."""
    return (
        f"it ends before its {element.rows} of element {element.name}:"
        " it is cut short, or a count in its header is wrong"
    )
