"""Embree intersects batches of rays with static triangles. Only this file imports embreex.

embreex takes (N, 3) float32 arrays with any strides, so the transpose of our (3, N) needs no copy. It ignores meshes
added after the first query. Rays aimed at the edges of a closed mesh never slipped through in its robust mode (0 of 1.2
million); in its default mode 1 in 20 did. Rays aimed exactly at a vertex still slip through at 2 vertices in 1000.
"""

from dataclasses import dataclass
from threading import Lock
from time import perf_counter
from typing import Any, Protocol

import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene

from course.core.types import Floats32, Mask, Numbers

NO_HIT = 1e37
"""Distance that embreex returns for a ray without a hit."""


@dataclass
class QueryStats:
    """Seconds inside Embree, or box and triangle tests of another BVH. Each thread has its own object."""

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
    t : (N,) float32, distance [length of the direction]
    """

    triangle: Numbers
    u: Floats32
    v: Floats32
    t: Floats32


class Accelerator(Protocol):
    """Interface of Embree, of the accelerator of moving triangles, and of other BVHs."""

    def intersect(
        self,
        origin: Floats32,
        direction: Floats32,
        stats: QueryStats,
        time: Floats32 | None = None,
        *,
        coherent: bool = False,
        excluded: Any = None,
    ) -> Intersections:
        """Nearest hit of each ray.

        Parameters
        ----------
        origin : (3, N) or (3, 1) float32
        direction : (3, N) float32, any length but 0
        stats : the seconds or the tests of the query are added to it
        time : (N,) float32 of each ray, as a share of the exposure; None if nothing moves
        coherent : true if neighbouring rays have similar directions
        excluded : the rays' ``Surface.excluded_objects``
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
        limit : [length of the direction]
        active : (N,) the rays to test, None for all; results of the others are undefined
        """


class EmbreeAccelerator:
    """Embree's BVH of vertices (V, 3) float32 and triangles (T, 3) int32, which the first query builds."""

    def __init__(self, vertices: Floats32, triangles: Numbers) -> None:
        self.vertices = np.ascontiguousarray(vertices, np.float32)
        self.triangles = np.ascontiguousarray(triangles, np.int32)
        # A BVH takes as much memory as all tables of the triangles, so an unused one is never built.
        self._scene: EmbreeScene | None = None
        self._build = Lock()

    def _built(self) -> EmbreeScene:
        with self._build:
            if self._scene is None:
                scene = EmbreeScene(robust=True)
                # Embree reads the mesh's arrays as long as the scene lives.
                self._mesh = TriangleMesh(scene, self.vertices, self.triangles)
                # The first query builds the BVH, and must come from one thread.
                away = np.full((1, 3), 4.0, np.float32)
                scene.run(away, away, query="OCCLUDED")
                self._scene = scene
        return self._scene

    def intersect(
        self,
        origin: Floats32,
        direction: Floats32,
        stats: QueryStats,
        time: Floats32 | None = None,
        *,
        coherent: bool = False,
        excluded: Any = None,
        limit: Floats32 | None = None,
    ) -> Intersections:
        """See ``Accelerator.intersect``; hits beyond ``limit`` (N,) float32 don't count."""
        n = direction.shape[1]
        if len(self.triangles) == 0 or n == 0:
            return no_hits(n)
        # embreex overwrites the array of limits with the distances.
        limits = None if limit is None else limit.copy()
        scene = self._built()
        start = perf_counter()
        found = scene.run(_rows(origin, n), direction.T, limits, query="INTERSECT", output=True)
        stats.seconds += perf_counter() - start
        return Intersections(found["primID"], found["u"], found["v"], found["tfar"])

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
        # Embree skips rays with a negative limit.
        limits = limit if active is None else np.where(active, np.float32(limit), np.float32(-1))
        scene = self._built()
        start = perf_counter()
        # 0 where the ray is blocked, -1 where it is free.
        blocked = scene.run(_rows(origin, n), direction.T, limits, query="OCCLUDED")
        stats.seconds += perf_counter() - start
        return blocked < 0  # type: ignore[no-any-return]


def no_hits(n: int) -> Intersections:
    """Intersections of n rays that hit nothing."""
    u, v = np.zeros((2, n), np.float32)
    return Intersections(np.full(n, -1, np.int32), u, v, np.full(n, NO_HIT, np.float32))


def _rows(origin: Floats32, n: int) -> Floats32:
    """(n, 3) view of the origins; stride 0 repeats a single one."""
    if origin.shape[1] == n:
        return origin.T
    # broadcast_to would give a read-only view, which embreex refuses.
    return np.lib.stride_tricks.as_strided(origin, (n, 3), (0, origin.strides[0]))
