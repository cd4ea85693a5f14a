"""Lists of several lengths, as files of polygons have them, and polygons cut into triangles."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from course.core.types import Indices


@dataclass(frozen=True)
class Lists:
    """A list of numbers for each of N rows.

    Attributes
    ----------
    lengths : (N,) int64
    values : (sum of the lengths,)
        Those of the first row, then those of the second, and so on.
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

    Parameters
    ----------
    lengths : (N,) corners of each polygon, 3 or more

    Returns
    -------
    (T, 3) intp, numbers of corners, which are counted through all polygons
    """
    triangles = lengths - 2
    first = np.repeat(np.cumsum(lengths) - lengths, triangles)
    number = np.arange(triangles.sum()) - np.repeat(np.cumsum(triangles) - triangles, triangles)
    return np.stack([first, first + number + 1, first + number + 2], axis=1).astype(np.intp)


def too_few(face: str, corners: int) -> str:
    """What is wrong with a face that is none."""
    plural = "" if corners == 1 else "s"
    return f"{face} has {corners} corner{plural}: expected 3 or more, or no such face"
