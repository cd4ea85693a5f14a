"""How far rays have travelled, where it counts to less than the offset from which they leave a surface."""

from __future__ import annotations

import numpy as np

from course.core.types import Floats32, Indices
from course.core.vectors import dot
from course.geometry.hits import Hits
from course.transport.paths import Rays

_LEAST = np.float32(1e-20)


def way_between(rays: Rays, hits: Hits, which: Indices) -> Floats32:
    """How far it is to some of the hits (m,) from the hits that the rays have left, and not from beside those.

    The plane of the triangle that is hit says how much sooner or later a ray from the very hit would have met it. As
    long as the way is at most, for a ray along a plane meets it anywhere.

    Parameters
    ----------
    rays : all of them, also those that have hit nothing
    """
    length: Floats32 = hits.t.take(which)
    if rays.start is None:
        return length
    ray = which if hits.ray is None else hits.ray.take(which)
    ng, direction = hits.ng.take(which, axis=1), hits.direction.take(which, axis=1)
    beside = rays.origin.take(ray, axis=1) - rays.start.take(ray, axis=1)
    # Normals are on the incoming side.
    facing = np.minimum(dot(ng, direction), -_LEAST)
    return length + np.clip(dot(ng, beside) / facing, -length, length)
