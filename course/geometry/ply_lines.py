"""The lines of a PLY file in text, checked one by one."""

from __future__ import annotations

import re

from course.geometry.mesh_polygons import too_few
from course.geometry.mesh_words import real, whole
from course.geometry.ply_header import CORNERS, WEDGES, Element, Header, Property, cut_short

_WHOLE = re.compile(r"[-+\d\s]*")


def checked_lines(header: Header, data: bytes) -> list[tuple[Element, list[str]]]:
    """Return the lines of each element of a PLY file in text, the empty ones left out.

    Raises
    ------
    ValueError
        For lines that are missing or left over, and, with its number, for one that has not as many numbers as its
        element's properties say, whose face has fewer than three corners, a corner that is no whole number, or uv that
        are not two for each corner.
    """
    lines = data[header.end :].decode("ascii", "replace").splitlines()
    filled = [k for k, line in enumerate(lines) if line and not line.isspace()]
    found = []
    first = 0
    for element in header.elements:
        if first + element.rows > len(filled):
            raise ValueError(cut_short(element))
        rows = filled[first : first + element.rows]
        found.append((element, [lines[k] for k in rows]))
        if not _surely_right(*found[-1]):
            for number, k in enumerate(rows):
                trouble = _trouble(element, number, lines[k])
                if trouble:
                    raise ValueError(f"line {header.lines + k + 1}: {trouble}")
        first += element.rows
    if first < len(filled):
        raise ValueError(
            f"line {header.lines + filled[first] + 1} is left over: a count in its header is wrong"
        )
    return found


def word_that_is_no_number(header: Header, data: bytes) -> str | None:
    """What to say of the first word in the data that is no number; None where all are."""
    lines = data[header.end :].decode("ascii", "replace").splitlines()
    for number, line in enumerate(lines, start=header.lines + 1):
        for word in line.split():
            try:
                real(word)
            except ValueError:
                return f"line {number}: {word[:40]!r} is no number"
    return None


def _surely_right(element: Element, lines: list[str]) -> bool:
    """Whether nothing is wrong with an element's lines, found out quickly; where it isn't sure, they are looked at."""
    if all(each.count is None for each in element.properties):
        return all(len(line.split()) == len(element.properties) for line in lines)
    if len(element.properties) > 1 or not _WHOLE.fullmatch("\n".join(lines)):
        return False
    # Few forms for many faces: how long its list is to be, and how many words there are.
    forms = {(words[0], len(words)) for words in map(str.split, lines)}
    return all(count.isdigit() and 3 <= int(count) == words - 1 for count, words in forms)


def _trouble(element: Element, number: int, line: str) -> str | None:
    """What is wrong with a line, the data of the element's thing of that number."""
    words = line.split()
    at = 0
    lengths: dict[str, int] = {}
    for each in element.properties:
        if each.count is None:
            at += 1
            continue
        # Lists that are cut off are told by the number of words.
        length = 0
        if at < len(words):
            try:
                length = whole(words[at])
            except ValueError:
                return f"{words[at][:40]!r} is no count of numbers to come"
            if length < 0 and each.name not in CORNERS:
                return f"the list {each.name} of {element.name} {number} has {length} numbers: expected 0 or more"
        lengths["corners" if each.name in CORNERS else each.name] = length
        if each.name in CORNERS and element.name == "face":
            if at < len(words) and length < 3:
                return too_few(f"face {number}", length)
            if not _WHOLE.fullmatch(line):
                wrong = _not_whole(words[at + 1 : at + 1 + length])
                if wrong:
                    return f"corner {wrong[:40]!r} of face {number}: expected a whole number"
        at += 1 + max(length, 0)
    if at == len(words):
        wedges, corners = lengths.get(WEDGES, 0), lengths.get("corners", 0)
        if element.name == "face" and wedges not in (0, 2 * corners):
            return wrong_wedges(number, wedges, corners)
        return None
    return f"{len(words)} numbers for {element.name} {number}: expected {at}, {_form(element.properties)}"


def wrong_wedges(face: int, numbers: int, corners: int) -> str:
    """What is wrong with a face's list of uv."""
    return (
        f"{WEDGES} of face {face} has {numbers} number{'' if numbers == 1 else 's'}:"
        f" expected {2 * corners}, u and v for each of its {corners} corners, or 0 for a face without"
    )


def _not_whole(words: list[str]) -> str | None:
    for word in words:
        try:
            if not real(word).is_integer():
                return word
        except ValueError:
            return word
    return None


def _form(properties: tuple[Property, ...]) -> str:
    """A line of an element in words."""
    return " ".join(
        each.name if each.count is None else f"count {each.name}..." for each in properties
    )
