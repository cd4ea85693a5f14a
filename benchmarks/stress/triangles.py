"""One square [-1, 1]^2 cut into triangles in many ways, good ones and bad ones."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

THIN = 33
"""Lines that lie close together."""


@dataclass(frozen=True)
class Cut:
    """A square in triangles, counter-clockwise.

    Attributes
    ----------
    points : (V, 2) in [-1, 1]
    triangles : (T, 3)
    below : (V,) how far each vertex lies below the plane
    """

    points: Array
    triangles: NDArray[np.intp]
    below: Array


def cut(kind: str, size: float | None, *, closed: bool) -> Cut:
    """The square cut in one way.

    Parameters
    ----------
    kind, size : of the axis "triangles"
    closed : leave the square's border without vertices but its corners, so that squares with common corners make a
        watertight box
    """
    middle = 2 * np.arange(-(THIN // 2), THIN // 2 + 1, dtype=np.float64)
    ends = np.array([-1.0, 1.0])
    match kind:
        case "strips" if size:
            return _grid(ends, np.union1d(ends, middle / size), closed)
        case "needles" if size:
            return _needles(middle / size)
        case "graded" if size:
            powers = 10.0 ** np.linspace(np.log10(size), 0, 7)
            lines = np.concatenate((-powers[::-1], [0.0], powers))
            return _grid(lines, lines, closed)
        case "fine" if size:
            lines = np.linspace(-1, 1, int(size) + 1)
            return _grid(lines, lines, closed)
        case "no area":
            return _without_area(_grid(ends, ends, closed=False))
        case "doubled":
            return _twice(_grid(ends, ends, closed=False), 0.0)
        case "sheets" if size:
            return _twice(_grid(ends, ends, closed=False), size)
    return _grid(ends, ends, closed=False)


def _flat(points: Array, triangles: NDArray[np.intp]) -> Cut:
    return Cut(points, triangles, np.zeros(len(points)))


def _grid(u: Array, v: Array, closed: bool) -> Cut:
    """Lines across the square; where it is to be closed they end before the border, and fans fill the ring."""
    inner = 0.9 if closed else 1.0
    points = np.array([[a, b] for b in inner * v for a in inner * u])
    i, j = np.meshgrid(np.arange(len(u) - 1), np.arange(len(v) - 1))
    first = (j * len(u) + i).ravel()
    n = len(u)
    lower = np.stack((first, first + 1, first + n + 1), axis=1)
    upper = np.stack((first, first + n + 1, first + n), axis=1)
    triangles = np.concatenate((lower, upper))
    if not closed:
        return _flat(points, triangles)
    corners = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
    at = len(points)
    index = np.arange(at).reshape(len(v), n)
    sides = (index[0], index[:, -1], index[-1, ::-1], index[::-1, 0])
    ring = [triangles]
    for number, side in enumerate(sides):
        ring.append(_fans(at + number, at + (number + 1) % 4, side))
    return _flat(np.concatenate((points, corners)), np.concatenate(ring))


def _fans(start: int, end: int, side: NDArray[np.intp]) -> NDArray[np.intp]:
    """Between an edge from corner start to corner end and the points along it, in the same direction."""
    middle = len(side) // 2
    rows = [[start, side[k + 1], side[k]] for k in range(middle)]
    rows += [[start, end, side[middle]]]
    rows += [[end, side[k + 1], side[k]] for k in range(middle, len(side) - 1)]
    return np.array(rows, np.intp)


def _needles(spread: Array) -> Cut:
    """Fans from the four corners to points that lie close together in the middle."""
    inner = np.stack((spread, 0 * spread), axis=1)
    corners = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
    n, middle = len(spread), len(spread) // 2
    bl, br, tr, tl = range(n, n + 4)
    rows = [[bl, k + 1, k] for k in range(middle)] + [[bl, br, middle]]
    rows += [[br, k + 1, k] for k in range(middle, n - 1)] + [[br, tr, n - 1]]
    rows += [[tr, k - 1, k] for k in range(n - 1, middle, -1)] + [[tr, tl, middle]]
    rows += [[tl, k - 1, k] for k in range(middle, 0, -1)] + [[tl, bl, 0]]
    return _flat(np.concatenate((inner, corners)), np.array(rows, np.intp))


def _without_area(square: Cut) -> Cut:
    """With triangles added that have no area, or none in float32."""
    extra = np.array(
        [[0.0, 0.0], [1e-30, 0.0], [0.0, 1e-30], [1e-30, 1e-30], [0.5, 0.5], [0.5, 0.5]]
    )
    at = len(square.points)
    flat = [[0, 0, 1], [0, 3, 3], [0, at, 3], [at, at + 1, at + 3], [at, at + 3, at + 2]]
    flat += [[at + 4, at + 5, at + 4], [1, at + 4, at + 5], [2, 2, 2]]
    points = np.concatenate((square.points, extra))
    # Zero-area triangles first, so that dropping them renumbers all the others.
    return _flat(points, np.concatenate((np.array(flat, np.intp), square.triangles)))


def _twice(square: Cut, below: float) -> Cut:
    """With a copy some way below."""
    n = len(square.points)
    return Cut(
        np.concatenate((square.points, square.points)),
        np.concatenate((square.triangles, square.triangles + n)),
        np.concatenate((square.below, square.below + below)),
    )
