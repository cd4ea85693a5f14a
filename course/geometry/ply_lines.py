"""The lines of a PLY file in text, checked one by one: trimesh's parser takes numbers that are too many or too few."""

from __future__ import annotations

import re

from course.geometry.ply_header import CORNERS, Element, Header, Property, cut_short

_WHOLE = re.compile(r"[-+\d\s]*")


def checked_lines(header: Header, data: bytes) -> bytes:
    """Return the data of a PLY file in text, without its empty lines.

    Raises
    ------
    ValueError
        For lines that are missing or left over, and, with its number, for one that has not as many numbers as its
        element's properties say, whose face has fewer than three corners, or a corner that is no whole number.
    """
    lines = data[header.end :].decode("ascii", "replace").splitlines()
    filled = [k for k, line in enumerate(lines) if line and not line.isspace()]
    first = 0
    for element in header.elements:
        if first + element.rows > len(filled):
            raise ValueError(cut_short(element))
        rows = filled[first : first + element.rows]
        if not _surely_right(element, [lines[k] for k in rows]):
            for number, k in enumerate(rows):
                trouble = _trouble(element, number, lines[k])
                if trouble:
                    raise ValueError(f"line {header.lines + k + 1}: {trouble}")
        first += element.rows
    if first < len(filled):
        raise ValueError(
            f"line {header.lines + filled[first] + 1} is left over: a count in its header is wrong"
        )
    return "\n".join(lines[k] for k in filled).encode()


def word_that_is_no_number(header: Header, data: bytes) -> str | None:
    """What to say of the first word in the data that is no number; None where all are."""
    lines = data[header.end :].decode("ascii", "replace").splitlines()
    for number, line in enumerate(lines, start=header.lines + 1):
        for word in line.split():
            try:
                float(word)
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
    for each in element.properties:
        if each.count is None:
            at += 1
            continue
        # Lists that are cut off are told by the number of words.
        length = 0
        if at < len(words):
            try:
                length = int(words[at])
            except ValueError:
                return f"{words[at][:40]!r} is no count of numbers to come"
        if each.name in CORNERS and element.name == "face":
            if at < len(words) and length < 3:
                return too_few(number, length)
            if not _WHOLE.fullmatch(line):
                wrong = _not_whole(words[at + 1 : at + 1 + length])
                if wrong:
                    return f"corner {wrong[:40]!r} of face {number}: expected a whole number"
        at += 1 + max(length, 0)
    if at == len(words):
        return None
    return f"{len(words)} numbers for {element.name} {number}: expected {at}, {_form(element.properties)}"


def too_few(face: int, corners: int) -> str:
    """What is wrong with a face that is none."""
    return f"face {face} has {corners} corner{'' if corners == 1 else 's'}: expected 3 or more, or no such face"


def _not_whole(words: list[str]) -> str | None:
    for word in words:
        try:
            if not float(word).is_integer():
                return word
        except ValueError:
            return word
    return None


def _form(properties: tuple[Property, ...]) -> str:
    """A line of an element in words."""
    return " ".join(
        each.name if each.count is None else f"count {each.name}..." for each in properties
    )
