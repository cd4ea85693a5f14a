"""Triangles over shared vertices, how far they reach, and small things beside which they are cut."""

from dataclasses import dataclass

import numpy as np

from course.engine.core import ray_offset
from course.engine.core.types import Floats64, Indices
from course.engine.core.vectors import cross, dot

TOO_LARGE = 1024.0
"""Largest offset of rays beside a thing, in OFFSETs of the thing's size, that is invisible.

It is then a 512th of the size, and changes a picture full of the thing's shadows by less than 1e-3.
"""

NEAR = 2.0
"""A triangle whose largest coordinate is at most this many times that of its nearest point is not cut: it would be of
little use."""

FLAT = 2.0**-24
"""Height of a triangle without area in float32, as a share of its largest coordinate."""


@dataclass(frozen=True)
class SharedTriangles:
    """Triangles over shared vertices.

    Attributes
    ----------
    vertices : (V, 3) float64
    corners : (T, 3) intp, counter-clockwise seen from the front; the edge from corner 0 to corner 1 is next
    origin : (T,) intp, the triangle that each was a part of in the beginning
    """

    vertices: Floats64
    corners: Indices
    origin: Indices

    @property
    def size(self) -> int:
        """Number of triangles."""
        return len(self.corners)

    def areas(self) -> Floats64:
        """(T,)."""
        p = self.vertices[self.corners]
        areas: Floats64 = np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1) / 2
        return areas


@dataclass(frozen=True)
class SmallThings:
    """F boxes in which something small lies.

    Attributes
    ----------
    low, high : (F, 3) float64, their corners
    size : (F,) float64, of what lies there, positive
    """

    low: Floats64
    high: Floats64
    size: Floats64

    @property
    def least(self) -> float:
        """Size of the smallest; infinite where there are none."""
        return float(self.size.min(initial=np.inf))

    def limit(self, low: Floats64, high: Floats64) -> Floats64:
        """(T,) the least of what lies beside boxes (T, 3): sizes of things, or their distances if they are more."""
        # A thing at a time: they may be many, and so may the boxes, but seldom both.
        found = np.full(len(low), np.inf)
        for thing_low, thing_high, size in zip(self.low, self.high, self.size, strict=True):
            apart = largest(np.maximum(low - thing_high, thing_low - high))
            np.minimum(found, np.maximum(apart, size), out=found)
        return found


def ends_of(p: Floats64) -> tuple[Floats64, Floats64]:
    """Lowest and highest corners (T, 3) of the boxes of triangles (T, 3 corners, 3)."""
    # Corner by corner: along a short axis, NumPy takes ten times as long.
    a, b, c = p.transpose(1, 0, 2)
    return np.minimum(np.minimum(a, b), c), np.maximum(np.maximum(a, b), c)


def largest(rows: Floats64) -> Floats64:
    """(T,) the largest of each row of (T, 3), at least 0."""
    x, y, z = rows.T
    return np.asarray(np.maximum(np.maximum(np.maximum(x, y), z), 0))


def nearest_of(low: Floats64, high: Floats64) -> Floats64:
    """(T,) the largest coordinate of the point of each box (T, 3) where that is least."""
    return largest(np.maximum(low, -high))


def raised_offsets(p: Floats64) -> Floats64:
    """Least offsets (T,) of triangles (T, 3 corners, 3) because they are thin, 0 of others or without an area."""
    corners = p.transpose(1, 2, 0)
    e1, e2, e3 = (corners[j] - corners[i] for i, j in ((0, 1), (0, 2), (1, 2)))
    longest = np.sqrt(np.maximum(np.maximum(dot(e1, e1), dot(e2, e2)), dot(e3, e3)))
    normal = cross(e1, e2)
    twice_area = np.sqrt(dot(normal, normal))
    low, high = ends_of(p)
    reach = largest(np.maximum(-low, high))
    there = twice_area > FLAT * reach * longest
    thin = np.flatnonzero(there & (longest * longest > ray_offset.SLIVER * twice_area))
    found = np.zeros(len(p))
    found[thin] = ray_offset.raised(longest[thin], twice_area[thin])
    return found
