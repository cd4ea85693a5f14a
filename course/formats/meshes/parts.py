"""Shared by the readers of mesh files: their result, numbers in text, lists of several lengths, and equal rows.

Python's own `float` and `int` read more than numbers as mesh files write them: 1_0 as ten, and digits of other scripts.
In a file these are slips, or it is cut up wrongly; and NumPy, which reads the usual file in one go, takes neither.
"""

import logging
from dataclasses import dataclass
from io import BytesIO
from typing import Any

import numpy as np
from numpy.typing import NDArray

from course.core.types import Floats64, Indices

Array = NDArray[Any]

# What trimesh makes of a wrong file it writes to its log, tracebacks too, which Python prints if nobody listens.
logging.getLogger("trimesh").addHandler(logging.NullHandler())


@dataclass(frozen=True)
class Part:
    """One geometry of a file, as it stands there: nothing is checked.

    Attributes
    ----------
    vertices : (V, 3)
    triangles : (T, 3) integer
    normals : (V, 3) or None, of any length
    uv : (V, 2) or None, v upwards
    transform : (4, 4) float64, from the part's frame to the file's
    facets : (T, 3) or None, the triangles' own normals as the file has them
    """

    vertices: Array
    triangles: Array
    normals: Array | None
    uv: Array | None
    transform: NDArray[np.float64]
    facets: Array | None = None


def parse_stl(data: bytes) -> list[Part]:
    """Return the solids of an STL file, each triangle with vertices of its own."""
    from trimesh.exchange.stl import load_stl

    return _parts(load_stl(BytesIO(data)))


def _parts(parsed: dict[str, Any]) -> list[Part]:
    """Return the parts of trimesh's keyword arguments for one mesh or for a scene of several."""
    geometries = parsed.get("geometry", {"": parsed})
    return [part for g in geometries.values() if (part := part_of(g, np.eye(4))) is not None]


def part_of(
    geometry: dict[str, Any], transform: NDArray[np.float64], uv: Array | None = None
) -> Part | None:
    """Return the Part of trimesh's keyword arguments for one mesh, None if it has no faces."""
    faces = geometry.get("faces")
    if faces is None or len(faces) == 0:
        return None
    return Part(
        vertices=np.asarray(geometry["vertices"]),
        triangles=np.asarray(faces, np.int64),
        normals=geometry.get("vertex_normals"),
        uv=uv,
        transform=transform,
        facets=geometry.get("face_normals"),
    )


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


def fans(lengths: NDArray[np.int64]) -> Indices:
    """Return where the corners of triangles stand among those of polygons.

    A polygon 0 1 2 3 becomes 0 1 2 and 0 2 3, in its place.
    ``lengths``: (N,) corners of each polygon, 3 or more.
    Returns (T, 3) intp, numbers of corners, which are counted through all polygons.
    """
    triangles = lengths - 2
    first = np.repeat(np.cumsum(lengths) - lengths, triangles)
    number = np.arange(triangles.sum()) - np.repeat(np.cumsum(triangles) - triangles, triangles)
    return np.stack([first, first + number + 1, first + number + 2], axis=1).astype(np.intp)


def too_few(face: str, corners: int) -> str:
    """The error of an invalid face."""
    plural = "" if corners == 1 else "s"
    return f"{face} has {corners} corner{plural}: expected 3 or more, or no such face"


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
