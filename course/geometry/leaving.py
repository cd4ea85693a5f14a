"""Directions in which rays leave a surface: mirrored ones, and those that must stay on one side."""

from __future__ import annotations

import numpy as np

from course.core.types import Floats32, Indices
from course.core.vectors import dot, reflect
from course.geometry.hits import Hits


def mirrored_above(hits: Hits, which: Indices, ng: Floats32, keeps: bool = False) -> Floats32:
    """Directions (3, m) in which some of the hits mirror, by their shading normals but never into the surface.

    Parameters
    ----------
    which : (m,) which hits
    ng : (3, m) their geometric normals
    keeps : whether directions into the surface are kept after all
    """
    if hits.compiled and not keeps:
        from course.geometry import hit_kernels

        way = np.empty(ng.shape, np.float32)
        arrays = map(np.ascontiguousarray, (hits.direction, hits.ns, ng))
        hit_kernels.mirror(np.ascontiguousarray(which, np.int64), *arrays, way)
        return way
    direction, ns = hits.direction.take(which, axis=1), hits.ns.take(which, axis=1)
    way = reflect(direction, ns)
    return way if keeps else kept_above(way, ng)


def kept_above(direction: Floats32, ng: Floats32) -> Floats32:
    """Directions that an interpolated normal has sent to the wrong side of the surface, mirrored out of it."""
    below = np.minimum(dot(direction, ng), 0)
    if not below.any():
        return direction
    below += below
    return np.subtract(direction, below * ng)
