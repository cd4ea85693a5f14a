"""Ray queries: the interfaces of accelerators and of the casters below them, and static triangles."""

from collections.abc import Callable
from dataclasses import dataclass
from threading import Lock
from time import perf_counter
from typing import Protocol

import numpy as np

from course.engine.core.types import Floats32, Mask, Numbers

NO_HIT = 1e37
"""Distance of a ray without a hit."""


@dataclass
class QueryStats:
    """Seconds inside the caster, or the tests of a student's BVH. Each thread has its own object."""

    seconds: float = 0.0
    box_tests: int = 0
    triangle_tests: int = 0


@dataclass(frozen=True)
class Intersections:
    """Nearest hits of a batch of N rays.

    Attributes
    ----------
    triangle : (N,) int32, -1 where the ray hits nothing
    u, v : (N,) float32 barycentrics: p = (1 - u - v) p0 + u p1 + v p2
    t : (N,) float32, distance as a multiple of the direction's length
    """

    triangle: Numbers
    u: Floats32
    v: Floats32
    t: Floats32


class Accelerator(Protocol):
    """Interface of static and of moving triangles, and of a student's BVH."""

    def intersect(
        self,
        origin: Floats32,
        direction: Floats32,
        stats: QueryStats,
        time: Floats32 | None = None,
    ) -> Intersections:
        """Nearest hit of each ray.

        Parameters
        ----------
        origin : (3, N) or (3, 1) float32
        direction : (3, N) float32, any length but 0
        stats : the seconds or the tests of the query are added to it
        time : (N,) float32 of each ray, as a share of the exposure; None if nothing moves
        """

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
        """(N,) bool, true where nothing lies between origin and origin + limit * direction.

        Parameters
        ----------
        origin, direction, stats, time : see ``intersect``
        limit : length of the segment, as a multiple of the direction's
        active : (N,) the rays to test, None for all; results of the others are undefined
        """


class Caster(Protocol):
    """Triangles in a hierarchy: Embree, or what stands in for it (``course.engine.casters``)."""

    def nearest(self, origin: Floats32, direction: Floats32, limit: Floats32) -> Intersections:
        """Nearest hits of N > 0 rays; t is ``limit`` (N,) where none is nearer. ``limit`` may be overwritten."""

    def free(self, origin: Floats32, direction: Floats32, limit: Floats32 | float) -> Mask:
        """(N,) true where nothing lies between origin and origin + limit * direction, or the limit is negative."""


class StaticAccelerator:
    """Vertices (V, 3) float32 and triangles (T, 3) int32 in a caster, which is built at the first query."""

    def __init__(self, vertices: Floats32, triangles: Numbers, make: Callable[..., Caster]) -> None:
        self.vertices = np.ascontiguousarray(vertices, np.float32)
        self.triangles = np.ascontiguousarray(triangles, np.int32)
        self.make = make
        # A BVH takes as much memory as all tables of the triangles, so an unused one is never built.
        self._caster: Caster | None = None
        self._build = Lock()

    @property
    def caster(self) -> Caster:
        """The caster, of T > 0 triangles."""
        with self._build:
            if self._caster is None:
                self._caster = self.make(self.vertices, self.triangles)
        return self._caster

    def intersect(
        self,
        origin: Floats32,
        direction: Floats32,
        stats: QueryStats,
        time: Floats32 | None = None,
        *,
        limit: Floats32 | None = None,
    ) -> Intersections:
        """See ``Accelerator.intersect``; hits beyond ``limit`` (N,) float32 don't count."""
        n = direction.shape[1]
        if len(self.triangles) == 0 or n == 0:
            return no_hits(n)
        limits = np.full(n, NO_HIT, np.float32) if limit is None else limit.copy()
        caster, start = self.caster, perf_counter()
        found = caster.nearest(origin, direction, limits)
        stats.seconds += perf_counter() - start
        return found

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
        """See ``Accelerator.unoccluded``."""
        n = direction.shape[1]
        if len(self.triangles) == 0 or n == 0:
            return np.ones(n, np.bool_)
        limits = limit if active is None else np.where(active, np.float32(limit), np.float32(-1))
        caster, start = self.caster, perf_counter()
        free = caster.free(origin, direction, limits)
        stats.seconds += perf_counter() - start
        return free


def no_hits(n: int) -> Intersections:
    """Intersections of n rays that hit nothing."""
    u, v = np.zeros((2, n), np.float32)
    return Intersections(np.full(n, -1, np.int32), u, v, np.full(n, NO_HIT, np.float32))
