"""Triangles in the hierarchy of the `bounding_volumes` module, in the place of Embree.

Every query goes through ``traverse``, those of shadow rays too: what lies nearest lies before the light or behind it.
It counts its tests, so a picture made this way says how much work it was.
"""

from threading import Lock
from typing import Any

import numpy as np

from course.base.errors import EffectError
from course.engine.core.accelerator import NO_HIT, Intersections, QueryStats
from course.engine.core.types import Floats32, Floats64, Functions, Mask, Numbers
from course.engine.core.vectors import cross, dot

TRAVERSE = "bounding_volumes.traverse"


class HierarchyAccelerator:
    """Triangles that stand still; tests are added to the stats.

    Parameters
    ----------
    vertices : (V, 3) float32
    triangles : (T, 3) int32
    bounding_volumes : functions of the module
    leaf_size : triangles that a leaf may hold
    """

    def __init__(
        self, vertices: Floats32, triangles: Numbers, bounding_volumes: Functions, leaf_size: int
    ) -> None:
        self._corners = [
            np.ascontiguousarray(vertices[triangles[:, corner]].T, np.float32)
            for corner in range(3)
        ]
        self._size = len(triangles)
        self._bounding_volumes = bounding_volumes
        self._leaf_size = leaf_size
        self._hierarchy: Any = None
        self._build = Lock()

    def intersect(
        self,
        origin: Floats32,
        direction: Floats32,
        stats: QueryStats,
        time: Floats32 | None = None,
    ) -> Intersections:
        """Nearest hit of each ray; see ``Accelerator.intersect``.

        Raises EffectError: a function returned something else than its contract says.
        """
        n = direction.shape[1]
        u, v = np.zeros((2, n), np.float32)
        triangle, t, *_ = self._nearest(origin, direction, stats)
        t = np.where(triangle < 0, np.float32(NO_HIT), t).astype(np.float32)
        hit = np.flatnonzero(triangle >= 0)
        u[hit], v[hit] = self._places(
            triangle.take(hit), _columns(origin, n)[:, hit], direction[:, hit], t.take(hit)
        )
        return Intersections(triangle.astype(np.int32, copy=False), u, v, t)

    def unoccluded(
        self,
        origin: Floats32,
        direction: Floats32,
        limit: float,
        stats: QueryStats,
        time: Floats32 | None = None,
        *,
        active: Mask | None = None,
    ) -> Mask:
        """True where nothing lies between origin and origin + limit * direction; see ``Accelerator.unoccluded``.

        Raises EffectError: a function returned something else than its contract says.
        """
        if active is not None:
            which = np.flatnonzero(active)
            free = np.ones(len(active), np.bool_)
            rays = _columns(origin, len(active)).take(which, axis=1), direction.take(which, axis=1)
            free[which] = self.unoccluded(*rays, limit, stats)
            return free
        triangle, t, *_ = self._nearest(origin, direction, stats)
        return (triangle < 0) | (t > limit)

    def box_tests(self, origin: Floats32, direction: Floats32) -> Numbers:
        """Number of boxes that each ray is tested with, (N,); arguments as in ``intersect``."""
        *_, boxes, _ = self._nearest(origin, direction, QueryStats())
        return boxes

    def _nearest(
        self, origin: Floats32, direction: Floats32, stats: QueryStats
    ) -> tuple[Numbers, Floats32, Numbers, Numbers]:
        """The results of ``traverse``, (n,) each; its tests are counted."""
        n = direction.shape[1]
        if self._size == 0 or n == 0:
            none = np.zeros(n, np.int32)
            return none - 1, np.full(n, NO_HIT, np.float32), none, none
        rays = np.ascontiguousarray(_columns(origin, n)), np.ascontiguousarray(direction)
        traversed = self._bounding_volumes.traverse(self._built(), *self._corners, *rays)
        triangle, t, boxes, triangles = traversed
        if not (triangle.min() >= -1 and triangle.max() < self._size):
            raise EffectError(
                f"{TRAVERSE} returned triangles from {triangle.min()} to {triangle.max()}:"
                f" expected -1, or one of 0 to {self._size - 1}"
            )
        stats.box_tests += int(boxes.sum())
        stats.triangle_tests += int(triangles.sum())
        return triangle, t, boxes, triangles

    def _built(self) -> Any:
        """The hierarchy, made by the first thread that asks."""
        with self._build:
            if self._hierarchy is None:
                lo = np.minimum.reduce(self._corners)
                hi = np.maximum.reduce(self._corners)
                self._hierarchy = self._bounding_volumes.build(lo, hi, self._leaf_size)
        return self._hierarchy

    def _places(
        self, triangle: Numbers, origin: Floats32, direction: Floats32, t: Floats32
    ) -> tuple[Floats64, Floats64]:
        """Barycentrics (n,) each of the points at t, moved to the triangle where rounding has put them beside it."""
        p0, p1, p2 = (corner[:, triangle].astype(np.float64) for corner in self._corners)
        along, across = p1 - p0, p2 - p0
        point = origin + direction.astype(np.float64) * t - p0
        normal = cross(along, across)
        area = dot(normal, normal)
        u = np.clip(dot(normal, cross(point, across)) / area, 0, 1)
        v = np.clip(dot(normal, cross(along, point)) / area, 0, 1 - u)
        return u, v


def _columns(origin: Floats32, n: int) -> Floats32:
    """(3, n) view of the origins, of which there may be one for all rays."""
    return np.broadcast_to(origin, (3, n))
