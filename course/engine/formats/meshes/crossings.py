"""Whether the edges of a polygon cross: all pairs of a small one, and neighbours along a moving line of a large one.

Shamos and Hoey, "Geometric intersection problems", 1976. Edges that only touch, or lie on each other as the two sides
of a bridge to a hole do, don't cross.
"""

import numpy as np

from course.engine.core.types import Floats64

SMALL = 400
"""Corners up to which all pairs are quicker."""

SURE = 1e-12
"""Twice the area, in units of the polygon's size squared, from which on a corner is beside an edge and not on it."""


def crosses(places: Floats64) -> bool:
    """Whether two edges of a polygon (L, 2) cross, at a point inside both."""
    size = np.abs(places).max()
    places = places / (size if size > 0 else 1.0)
    return _by_pairs(places) if len(places) <= SMALL else _along_a_line(places)


def _by_pairs(a: Floats64) -> bool:
    b = np.roll(a, -1, axis=0)
    edge = b - a
    # Of each edge and each corner, on which side of it: (edges, corners).
    side = edge[:, :1] * (a[:, 1] - a[:, 1:]) - edge[:, 1:] * (a[:, 0] - a[:, :1])
    sign = np.where(np.abs(side) > SURE, np.sign(side), 0)
    parted = sign * np.roll(sign, -1, axis=1) < 0
    return bool((parted & parted.T).any())


def _along_a_line(places: Floats64) -> bool:
    """The line moves along x; edges on it are kept in order, from below."""
    xs: list[float] = places[:, 0].tolist()
    ys: list[float] = places[:, 1].tolist()
    count = len(xs)
    order = np.lexsort((places[:, 1], places[:, 0])).tolist()
    rank = [0] * count
    for number, corner in enumerate(order):
        rank[corner] = number
    # An edge has the number of its first corner; its ends in the order in which the line meets them.
    ends = [
        (k, n) if rank[k] < rank[n] else (n, k)
        for k, n in ((k, (k + 1) % count) for k in range(count))
    ]

    def side(edge: int, corner: int) -> float:
        left, right = ends[edge]
        x, y = xs[left], ys[left]
        return (xs[right] - x) * (ys[corner] - y) - (ys[right] - y) * (xs[corner] - x)

    def cross(one: int, other: int) -> bool:
        a, b = side(one, ends[other][0]), side(one, ends[other][1])
        if not (abs(a) > SURE < abs(b) and a * b < 0):
            return False
        a, b = side(other, ends[one][0]), side(other, ends[one][1])
        return abs(a) > SURE < abs(b) and a * b < 0

    def place(corner: int, toward: int) -> int:
        """Where in the order an edge from a corner to another belongs."""
        low, high = 0, len(line)
        while low < high:
            middle = (low + high) // 2
            above = side(line[middle], corner)
            if above == 0:
                above = side(line[middle], toward)
            if above > 0:
                low = middle + 1
            else:
                high = middle
        return low

    line: list[int] = []
    for corner in order:
        for edge in ((corner - 1) % count, corner):
            left, right = ends[edge]
            if left == corner:
                at = place(left, right)
                if any(cross(edge, other) for other in line[max(0, at - 1) : at + 1]):
                    return True
                line.insert(at, edge)
                continue
            at = place(right, left)
            near = line[max(0, at - 2) : at + 2]
            at = max(0, at - 2) + near.index(edge) if edge in near else line.index(edge)
            del line[at]
            if 0 < at < len(line) and cross(line[at - 1], line[at]):
                return True
    return False
