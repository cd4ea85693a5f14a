"""Shared by the readers of mesh files: their result, numbers in text, lists of several lengths, and equal rows.

Python's own `float` and `int` read more than numbers as mesh files write them: 1_0 as ten, and digits of other scripts.
In a file these are slips, or it is cut up wrongly; and NumPy, which reads the usual file in one go, takes neither.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from course.engine.core.types import Floats64, Indices, Mask

Array = NDArray[Any]


@dataclass(frozen=True)
class FilePart:
    """One geometry of a file, as it stands there: nothing is checked.

    Attributes
    ----------
    vertices : (V, 3)
    triangles : (T, 3) integer
    normals : (V, 3) or None, of any length
    uv : (V, 2) or None, v upwards
    places : (K, 4, 4) float64, from the part's frame to the file's: it is there so many times
    facets : (T, 3) or None, the triangles' own normals as the file has them
    shared : (V,) or None, numbers of normals that the file doesn't have: vertices with the same one have the same
        normal, whatever lies beside them; None where vertices at one place are smooth up to a crease
    flat : whether every triangle has a normal of its own, as the file says without one
    names : of the file's materials
    name : (T,) integer or None, which of the names each triangle has; None where there are none
    bare : (T,) which triangles have no uv though others have, or None where none is so
    notes : what is to be told of the part, such as what of the file was passed over
    """

    vertices: Array
    triangles: Array
    normals: Array | None
    uv: Array | None
    places: NDArray[np.float64] = field(default_factory=lambda: np.eye(4)[None])
    facets: Array | None = None
    shared: Array | None = None
    flat: bool = False
    names: tuple[str, ...] = ()
    name: Array | None = None
    bare: Array | None = None
    notes: tuple[str, ...] = ()


def real(word: str) -> float:
    """Return the number that a word is, infinities and NaN among them; ValueError where it is none."""
    return float(_plain(word))


def whole(word: str) -> int:
    """Return the whole number that a word is, written without a point; ValueError where it is none."""
    return int(_plain(word))


def numbers(text: str) -> Floats64:
    """Return the numbers of a text in one go, (N,); fewer than it has words if one of these is none."""
    try:
        return np.fromstring(text, np.float64, sep=" ")
    except (ValueError, DeprecationWarning):
        return np.zeros(0)


def _plain(word: str) -> str:
    if "_" in word or not word.isascii():
        raise ValueError(f"{word[:40]!r} is no number")
    return word


@dataclass(frozen=True)
class Lists:
    """A list of numbers for each of N rows.

    Attributes
    ----------
    lengths : (N,) int64
    values : (sum of the lengths,), those of the first row, then those of the second, and so on
    """

    lengths: NDArray[np.int64]
    values: NDArray[Any]


def runs(
    items: NDArray[Any], starts: NDArray[np.int64], lengths: NDArray[np.int64]
) -> NDArray[Any]:
    """Return the runs of some (M,) items that begin at starts (N,), one after the other.

    Between one run and the next stands one item or more, unless there is nothing in one of them.
    """
    filled = lengths > 0
    change = np.zeros(len(items) + 1, np.int8)
    change[starts[filled]] = 1
    change[(starts + lengths)[filled]] = -1
    return items[np.cumsum(change[:-1], dtype=np.int8).astype(np.bool_)]


def doubtful(faces: Sequence[str]) -> tuple[str, ...]:
    """What is told of faces, named by where they stand, that cross themselves or have no area."""
    if not faces:
        return ()
    more = f" and {len(faces) - 1:,} more" if len(faces) > 1 else ""
    verb = "cross themselves or have" if more else "crosses itself or has"
    told = (
        f"{faces[0]}{more} {verb} no area: cut from a first corner, though nobody can tell what is inside; draw such a"
        " face anew, or as several"
    )
    return (told,)


def behind(count: int, of: int) -> tuple[str, ...]:
    """What is told of faces that stand in the file a second time, from the other side."""
    told = (
        f"{count:,} of its {of:,} faces are others seen from behind; without normals one of both sides is enough, and"
        " these were left out"
    )
    return (told,)


def too_few(face: str, corners: int) -> str:
    """The error of a face that has no corners at all."""
    return f"{face} has {corners} corners: expected 3 or more, or no such face"


def surfaces(lengths: NDArray[np.int64]) -> tuple[Mask, Indices] | None:
    """Return which faces have three corners or more, and the corners of these; None where all have."""
    kept = lengths > 2
    return None if kept.all() else (kept, np.flatnonzero(np.repeat(kept, lengths)))


def no_surface(faces: Sequence[str]) -> tuple[str, ...]:
    """What is told of faces of one or two corners, named by where they stand."""
    more = f" and {len(faces) - 1:,} more have" if len(faces) > 1 else " has"
    return (f"{faces[0]}{more} fewer than 3 corners, and so no surface: left out",)


def same(*columns: NDArray[Any]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Group the rows that are equal in every column, exactly; -0.0 equals 0.0.

    ``columns``: (N,) arrays of numbers, at least one, without NaN.

    Returns
    -------
    first : (G,) intp
        The first row of each group, groups in the order in which they first appear.
    group : (N,) intp
        The group of each row.
    """
    rows = len(columns[0])
    order = np.lexsort(columns[::-1])
    starts = np.zeros(rows, bool)
    starts[:1] = True
    for column in columns:
        ranked = column[order]
        starts[1:] |= ranked[1:] != ranked[:-1]
    # The sort is stable, so that a group's first row in it is its first row of all.
    first = order[starts]
    appearance = np.argsort(first, kind="stable")
    rank = np.empty_like(appearance)
    rank[appearance] = np.arange(len(first))
    group = np.empty(rows, np.intp)
    group[order] = rank[np.cumsum(starts) - 1]
    return first[appearance], group
