"""Packets of WIDTH rays for Embree, compiled by Numba.

Layout of a packet (Embree 4's rtcore_ray.h): rows of WIDTH floats or integers, origin, tnear, direction, time, tfar,
mask, id, flags; then of the hit Ng, u, v, primID, geomID, instID.
"""

from numba import types

from course.engine.loops import packets
from course.engine.loops.embree_device import name_queries, queries
from course.engine.loops.options import LEAN, njit

name_queries()

WIDTH = packets.WIDTH
TO, TFAR, MASK, U, V, PRIMITIVE, GEOMETRY = (row * WIDTH for row in (4, 8, 9, 15, 16, 17, 18))
"""Where rows begin in a packet that is one array: the direction's first, and others."""

_query = types.void(*[types.uintp] * 4)
intersect, occluded = (types.ExternalFunction(name, _query) for name in queries())


@njit(**LEAN)
def begin(s, whole):
    """What all rays of a packet that is one array have in common; ``whole`` is the same memory as integers."""
    s[:] = 0
    whole[MASK : MASK + WIDTH] = -1
