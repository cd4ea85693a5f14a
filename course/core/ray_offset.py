"""How far from a triangle its rays begin, so that rounding never lets a triangle block its own rays."""

from __future__ import annotations

import numpy as np

from course.core.types import Floats64

OFFSET = 2.0**-19
"""Height above a surface at which rays begin, as a share of the largest coordinate of its triangle.

The error of hit points, like that of Embree's test, is a few units in the last place (2^-24) of the triangle's
coordinates; measured in tests/geometry/test_surface.py.
"""

TILT, SLIVER, MOST = 0.5, 8.0, 1024.0
"""The offset of a long, thin triangle is at least OFFSET * TILT * (length / height - SLIVER) lengths, and that bound is
at most OFFSET * MOST lengths.

Embree's plane of such a triangle is tilted: it rounds a cross product of nearly parallel edges, taken relative to the
ray's origin. The hit's error in height is about 2^-24 length^2 / height.
"""

INSET = 2.0
"""Rays begin at least this many offsets inside the triangle's edges.

In an acute concave corner, a point above one wall and next to the edge may lie behind the other wall. With this inset
it lies in front for dihedral angles down to atan(1 / INSET) = 27 degrees.
"""


def offset_and_inset(
    p: Floats64, lengths: Floats64, twice_area: Floats64
) -> tuple[Floats64, Floats64]:
    """Offsets (T,) at which rays begin, and least barycentrics (3, T) of their origins.

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
    # A barycentric is the distance from the edge / height, and height = twice the area / edge length.
    return offset, np.minimum(INSET * offset * lengths / twice_area, 1 / 3)
