"""Corners of the faces of OBJ files: which vertex, uv and normal each refers to, or which line is wrong."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from course.engine.core.types import Indices
from course.engine.formats.meshes.parts import numbers, too_few, whole

KINDS = ("v", "vt", "vn")
"""The fields of a corner v/vt/vn, in their order."""

NOUNS = ("vertex", "uv", "normal")

MOST = 10**20
"""A number that no file can have so many rows for."""

_DIGITS = str.maketrans("", "", "0123456789")

Corners = tuple[Indices, Indices | None, Indices | None]
"""Of each corner of all faces the vertex, the uv and the normal, from 0; -1 where it has none, None where none has."""


@dataclass(frozen=True)
class Face:
    """One face as it is written.

    Attributes
    ----------
    line : its number, from 1
    text : what follows the f
    so_far : how many vertices, uv and normals stand before it, from which negative numbers count back; None where it
        has no such number
    """

    line: int
    text: str
    so_far: tuple[int, ...] | None


def corners_of(
    faces: Sequence[Face], there: tuple[int, int, int]
) -> tuple[NDArray[np.int64], Corners]:
    """Return how many corners each face has, (N,), and what these refer to.

    Raises ValueError, IndexError naming the line, as `course.engine.formats.meshes.obj.parse_obj` says.

    Parameters
    ----------
    faces : at least one
    there : how many vertices, uv and normals the file has
    """
    words = [face.text.split() for face in faces]
    lengths = np.array([len(each) for each in words], np.int64)
    if not lengths.all():
        raise ValueError(f"line {faces[int(np.argmin(lengths))].line}: {too_few('a face', 0)}")
    fields = _alike([word for each in words for word in each])
    if fields is None:
        rows = [
            _corner(word, face) for face, each in zip(faces, words, strict=True) for word in each
        ]
        fields = np.array(rows, np.float64).T
        _check_forms(faces, lengths, fields)
    found = []
    for noun, given, count in zip(NOUNS, fields, there, strict=True):
        wrong = (given > count) | (given < 0)
        if wrong.any():
            corner = int(np.argmax(wrong))
            face = int(np.searchsorted(np.cumsum(lengths), corner, side="right"))
            raise IndexError(_missing(faces[face], noun, float(given[corner]), count))
        found.append(given.astype(np.intp) - 1)
    v, vt, vn = found
    return lengths, (v, vt if (vt >= 0).any() else None, vn if (vn >= 0).any() else None)


def _alike(words: list[str]) -> NDArray[np.float64] | None:
    """(3, M) numbers from 1 of corners that all have one form, 0 for fields they haven't; None where it isn't sure.

    The usual case, found out without a loop: what is left without digits is the same in every corner.
    """
    form = words[0].translate(_DIGITS)
    hollow = "//" in words[0]
    which = {"": [0], "/": [0, 1], "//": [0, 2] if hollow else [0, 1, 2]}.get(form)
    text = " ".join(words)
    if which is None or text.translate(_DIGITS) != " ".join([form] * len(words)):
        return None
    # Without digits 1//3 and 1/2/3 are the same.
    if text.count("//") != hollow * len(words):
        return None
    values = numbers(text.replace("/", " "))
    if len(values) != len(words) * len(which) or values.min() < 1:
        return None
    fields = np.zeros((3, len(words)))
    fields[which] = values.reshape(-1, len(which)).T
    return fields


def _corner(word: str, face: Face) -> list[int]:
    """v, vt and vn of one corner, from 1; 0 for those it hasn't."""
    fields = word.split("/")
    if len(fields) > 3 or not fields[0]:
        raise ValueError(_no_corner(word, face))
    found = [0, 0, 0]
    for k, text in enumerate(fields):
        if not text:
            continue
        try:
            given = whole(text)
        except ValueError:
            raise ValueError(_no_corner(word, face)) from None
        counted = given
        if given < 0 and face.so_far is not None:
            counted = given + face.so_far[k] + 1
            if counted < 1:
                raise IndexError(
                    f"line {face.line}: a face refers to {NOUNS[k]} {given}, but before it there are {face.so_far[k]},"
                    f" {_back(face.so_far[k])}"
                )
        if counted == 0:
            raise IndexError(
                f"line {face.line}: a face refers to {NOUNS[k]} 0, but they count from 1,"
                " or back from -1"
            )
        found[k] = min(counted, MOST)
    return found


def _back(count: int) -> str:
    return f"from -1 back to -{count}" if count else "so that there is none to refer to"


def _no_corner(word: str, face: Face) -> str:
    return (
        f"line {face.line}: {word[:40]!r} is no corner of a face:"
        " expected whole numbers, as in 1, 1/2, 1//3 or 1/2/3"
    )


def _missing(face: Face, noun: str, given: float, count: int) -> str:
    among = f"from 1 to {count}" if count else "so that no face may have one"
    return (
        f"line {face.line}: a face refers to {noun} {given:.15g}, but there are {count}, {among}:"
        " correct the number, or add what is missing"
    )


def _check_forms(
    faces: Sequence[Face], lengths: NDArray[np.int64], fields: NDArray[np.float64]
) -> None:
    """Refuse faces of which some corners have uv or a normal and others haven't."""
    starts = np.cumsum(lengths) - lengths
    for noun, given in zip(NOUNS[1:], fields[1:], strict=True):
        having = np.add.reduceat((given > 0).astype(np.int64), starts)
        wrong = (having != 0) & (having != lengths)
        if wrong.any():
            k = int(np.argmax(wrong))
            raise ValueError(
                f"line {faces[k].line}: {having[k]} of the {lengths[k]} corners of a face have a {noun}:"
                " expected all of them, or none"
            )
