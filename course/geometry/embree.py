"""Embree: batches of rays against triangles. The one file that imports embreex.

What embreex does that one would not expect, and what is done about it here:

- it takes (N, 3) float32 arrays but any strides, so the transpose of our (3, N) goes in without a copy, and one
  origin shared by all rays as an array of stride 0;
- it overwrites the ``dists`` array in place, so limits are passed as a number or as an array made for the call;
- an occlusion query returns 0 for blocked and -1 for free;
- meshes added after the first query are ignored, so the scene is complete before it is asked anything;
- only robust mode finds the hits of all rays through the edges of a closed mesh (measured: 0 of 1.2 million lost, where
  the default mode loses 1 in 20); a ray aimed exactly at a vertex may still slip through, at 2 vertices in 1000.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from threading import Lock
from time import perf_counter

import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene

from course.core.types import Floats32, Indices, Mask, Numbers
from course.geometry.convex import ConvexObjects, Extent, Objects, convex_objects
from course.geometry.packets import PacketScene

NO_HIT = 1e37
"""The distance of a ray that hits nothing, as embreex has it."""

WORTH_CHOOSING = 0.75
"""Share of a batch up to which copying the rays in question costs less than asking all."""


@dataclass
class QueryTime:
    """Seconds spent inside Embree, or what a hierarchy in its place has tested; each thread holds one of its own."""

    seconds: float = 0.0
    box_tests: int = 0
    triangle_tests: int = 0


@dataclass(frozen=True)
class Intersections:
    """Nearest hits of a batch of N rays.

    Attributes
    ----------
    triangle : (N,) int32, -1 where the ray hits nothing
    u, v : (N,) float32, barycentric: p = (1 - u - v) p0 + u p1 + v p2
    t : (N,) float32, distance in lengths of the direction
    """

    triangle: Numbers
    u: Floats32
    v: Floats32
    t: Floats32


class Accelerator:
    """Triangles in Embree's hierarchy, behind ``course.geometry.accelerators.AnyAccelerator``.

    Parameters
    ----------
    vertices : (V, 3) float32
    triangles : (T, 3) int32
    extents : of the objects that they belong to, where these are known
    """

    def __init__(
        self, vertices: Floats32, triangles: Numbers, extents: Sequence[Extent] = ()
    ) -> None:
        self._vertices = np.ascontiguousarray(vertices, np.float32)
        self._triangles = np.ascontiguousarray(triangles, np.int32)
        self._extents = extents
        self._convex: ConvexObjects | None = None
        # A hierarchy takes as much memory as all else that is known of the triangles: there is none that isn't asked.
        self._scene: EmbreeScene | None = None
        self._packets: PacketScene | None = None
        self._packet_scene: PacketScene | None = None
        self._build = Lock()

    def use_packets(self, wanted: bool) -> None:
        """Ask for 16 rays at a time from now on, or no longer; see ``course.geometry.packets``.

        The hierarchy for that is built, unless there is one.
        """
        if len(self._triangles) == 0:
            return
        if not wanted:
            self._single()
        elif self._packet_scene is None:
            self._packet_scene = PacketScene(self._vertices, self._triangles)
            self._convex = convex_objects(self._vertices, self._triangles, self._extents)
        self._packets = self._packet_scene if wanted else None

    def _single(self) -> EmbreeScene:
        """The hierarchy that is asked for one ray after the other."""
        with self._build:
            if self._scene is None:
                scene = EmbreeScene(robust=True)
                # Embree reads the arrays for as long as the scene lives.
                self._mesh = TriangleMesh(scene, self._vertices, self._triangles)
                # The first query builds the hierarchy, and must come from one thread.
                away = np.full((1, 3), 4.0, np.float32)
                scene.run(away, away, query="OCCLUDED")
                self._scene = scene
        return self._scene

    @property
    def compiled(self) -> bool:
        """Whether compiled loops are used."""
        return self._packets is not None

    @property
    def convex(self) -> ConvexObjects | None:
        """The objects that triangles belong to, where compiled loops are used: they look at these."""
        return self._convex if self.compiled else None

    def intersect(
        self,
        origin: Floats32,
        direction: Floats32,
        clock: QueryTime,
        time: Floats32 | None = None,
        limit: Floats32 | None = None,
        coherent: bool = False,
        left: Objects | None = None,
    ) -> Intersections:
        """Nearest hit of each ray; see ``AnyAccelerator.intersect``.

        Parameters
        ----------
        time : of no consequence to triangles that don't move
        limit : (N,) float32, distances beyond which nothing counts
        """
        n = direction.shape[1]
        if len(self._triangles) == 0 or n == 0:
            u, v = np.zeros((2, n), np.float32)
            far = np.full(n, NO_HIT, np.float32)
            return Intersections(np.full(n, -1, np.int32), u, v, far)
        if self._packets is not None:
            start = perf_counter()
            far = np.full(1, NO_HIT, np.float32) if limit is None else limit
            which = None
            if left is not None and self._convex is not None:
                which = self._convex.remaining(origin, direction, far, left)
            hits = self._packets.intersect(origin, direction, far, coherent, which)
            clock.seconds += perf_counter() - start
            return Intersections(*hits)
        # Embree overwrites the limits.
        limits = None if limit is None else limit.copy()
        scene = self._single()
        start = perf_counter()
        found = scene.run(_rows(origin, n), direction.T, limits, query="INTERSECT", output=True)
        clock.seconds += perf_counter() - start
        return Intersections(found["primID"], found["u"], found["v"], found["tfar"])

    def entering(
        self, origin: Floats32, direction: Floats32, limit: Floats32, clock: QueryTime
    ) -> Indices | None:
        """Which rays (3, N) come so near, within their limits (N,) or (1,), that they are worth a query.

        Returns
        -------
        (n,) int, or None for all: where finding out would take as long as the query
        """
        if self._packets is None:
            return None
        start = perf_counter()
        which = self._packets.entering(origin, direction, limit)
        clock.seconds += perf_counter() - start
        return which if len(which) < WORTH_CHOOSING * direction.shape[1] else None

    def unoccluded(
        self,
        origin: Floats32,
        direction: Floats32,
        limit: float,
        clock: QueryTime,
        time: Floats32 | None = None,
        asked: Mask | None = None,
    ) -> Mask:
        """Whether nothing lies on the way; see ``AnyAccelerator.unoccluded``. Time is of no consequence."""
        n = direction.shape[1]
        if len(self._triangles) == 0 or n == 0:
            return np.ones(n, np.bool_)
        if self._packets is not None:
            start = perf_counter()
            free = self._packets.unoccluded(origin, direction, limit)
            clock.seconds += perf_counter() - start
            return free
        # Embree gives back at once what ends before it begins.
        limits = limit if asked is None else np.where(asked, np.float32(limit), np.float32(-1))
        scene = self._single()
        start = perf_counter()
        blocked = scene.run(_rows(origin, n), direction.T, limits, query="OCCLUDED")
        clock.seconds += perf_counter() - start
        return blocked < 0  # type: ignore[no-any-return]


def _rows(origin: Floats32, n: int) -> Floats32:
    """(n, 3) view of the origins; one column is repeated by a stride of 0."""
    if origin.shape[1] == n:
        return origin.T
    # broadcast_to would give a read-only view, which embreex refuses.
    return np.lib.stride_tricks.as_strided(origin, (n, 3), (0, origin.strides[0]))
