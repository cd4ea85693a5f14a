"""The distance from a triangle at which rays leave it, so that rounding never lets a triangle block its own rays."""

from __future__ import annotations

import numpy as np

from course.core.types import Floats64

OFFSET = 2.0**-19
"""Height above a surface at which rays leave it, as a share of the largest coordinate of its triangle.

Hit points come from barycentrics. Their error, like that of Embree's test, is a few units in the last place (2^-24) of
the triangle's coordinates; measured in tests/geometry/test_surface.py.
"""

SLIVER = 8.0
"""A triangle is long and thin if its length / height exceeds this.

Embree's plane of such a triangle is tilted: it rounds a cross product of nearly parallel edges, taken relative to the
ray's origin. The hit's error in height is about 2^-24 length^2 / height.
"""

TILT = 0.5
"""The offset of a thin triangle is at least OFFSET * TILT * (length / height - SLIVER) lengths."""

MOST = 1024.0
"""The lower bound that TILT gives is clamped to OFFSET * MOST lengths."""

INSET = 2.0
"""Rays leave at least this many offsets inside the triangle's edges.

In an acute concave corner, a point above one wall and next to the edge may lie behind the other wall. With this inset
it lies in front for dihedral angles down to atan(1 / INSET) = 27 degrees.
"""


def offset_and_inset(
    p: Floats64, lengths: Floats64, twice_area: Floats64
) -> tuple[Floats64, Floats64]:
    """Heights (T,) at which rays leave triangles, and barycentrics (3, T) below which a point is next to an edge.

    Parameters
    ----------
    p : (3, 3, T) corners
    lengths : (3, T) of the edges opposite the corners 0, 1 and 2
    twice_area : (T,)
    """
    longest = lengths.max(axis=0, initial=0)
    thinness = longest * longest / twice_area
    tilt = longest * np.clip(TILT * (thinness - SLIVER), 0, MOST)
    offset = OFFSET * np.maximum(np.abs(p).max(axis=(0, 1), initial=0), tilt)
    # Barycentric = distance from the edge / height of the triangle; height = twice the area / edge length.
    return offset, np.minimum(INSET * offset * lengths / twice_area, 1 / 3)
