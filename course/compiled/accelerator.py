"""Embree or its stand-in asked for sixteen rays at a time, and the boxes of convex objects before it."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from time import perf_counter
from typing import Any
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from course.compiled.convex import ConvexObjects, convex_objects
from course.compiled.packets import COHERENT, PacketScene, packets_of
from course.core.accelerator import (
    NO_HIT,
    Accelerator,
    Intersections,
    QueryStats,
    StaticAccelerator,
    no_hits,
)
from course.core.motion import Mover, MovingAccelerator
from course.core.types import Floats32, Indices, Mask
from course.extras.own import courses_own
from course.extras.own_lamp import LampAccelerator
from course.extras.plan import same_fields

WORTH_CHOOSING = 0.75
"""Share of a batch up to which copying the rays in question costs less than asking all."""

_FAR, _ALL = np.full(1, NO_HIT, np.float32), np.empty(0, np.bool_)

_CONVEX: WeakKeyDictionary[StaticAccelerator, ConvexObjects | None] = WeakKeyDictionary()
"""What has been found: a scene is rendered more than once."""


@dataclass(frozen=True)
class SceneTables:
    """What stands still and K movers, as ``occlusion_kernels`` has them.

    Attributes
    ----------
    scenes : (1 + K,) uint64, Embree's; 0 where there are no triangles
    blockers : (1 + K,) uint64, those that shadow rays are asked of
    velocity, boxes : (K, 3) and (K, 2, 3) float32 of the movers
    """

    scenes: NDArray[np.uintp]
    blockers: NDArray[np.uintp]
    velocity: Floats32
    boxes: Floats32

    @classmethod
    def of(
        cls, static: "PacketAccelerator", movers: Sequence[tuple[PacketScene, Floats32]]
    ) -> "SceneTables":
        """Tables of scenes, of the movers with their velocities."""
        moving = [scene.scene for scene, _ in movers]
        scenes, blockers = (
            np.array([0 if still is None else still.scene, *moving], np.uintp)
            for still in (static.packets, static.blockers)
        )
        velocity = np.zeros((len(movers), 3), np.float32)
        boxes = np.zeros((len(movers), 2, 3), np.float32)
        for number, (scene, each) in enumerate(movers):
            velocity[number], boxes[number] = each, scene.box
        return cls(scenes, blockers, velocity, boxes)


@dataclass(frozen=True, eq=False)
class PacketAccelerator(StaticAccelerator):
    """Triangles that stand still; see ``StaticAccelerator``.

    Attributes
    ----------
    packets : None where there are no triangles
    blockers : those of which shadow rays are asked
    convex : the objects that the triangles belong to, where looking at these spares queries
    apart : whether most rays pass by all triangles, so that their box is looked at first
    """

    packets: PacketScene | None
    blockers: PacketScene | None = None
    convex: ConvexObjects | None = None
    apart: bool = False

    @property
    def tables(self) -> SceneTables:
        """For loops over packets."""
        return SceneTables.of(self, ())

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
        """See ``StaticAccelerator``; ``excluded`` (N,) is the convex object that each ray leaves."""
        n = direction.shape[1]
        if self.packets is None or n == 0:
            return no_hits(n)
        start = perf_counter()
        far = _FAR if limit is None else limit
        which = None
        if excluded is not None and self.convex is not None:
            which = self.convex.remaining(origin, direction, far, excluded)
        elif (
            self.apart
            and len(some := self.packets.entering(origin, direction, far)) < WORTH_CHOOSING * n
        ):
            hits = self._some(some, origin, direction, far, coherent)
            stats.seconds += perf_counter() - start
            return hits
        hits = Intersections(*self.packets.intersect(origin, direction, far, coherent, which))
        stats.seconds += perf_counter() - start
        return hits

    def _some(
        self, which: Indices, origin: Floats32, direction: Floats32, limit: Floats32, coherent: bool
    ) -> Intersections:
        """Nearest hits of some rays (m,) of (3, N): copies in one piece are faster than to pick them out."""
        assert self.packets is not None
        found = no_hits(direction.shape[1])
        start = origin if origin.shape[1] == 1 else origin.take(which, axis=1)
        far = limit if len(limit) == 1 else limit.take(which)
        arrays = self.packets.intersect(start, direction.take(which, axis=1), far, coherent)
        for mine, theirs in zip((found.triangle, found.u, found.v, found.t), arrays, strict=True):
            mine[which] = theirs
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
        """See ``StaticAccelerator``."""
        n = direction.shape[1]
        if self.blockers is None or n == 0:
            return np.ones(n, np.bool_)
        start = perf_counter()
        which = None
        if self.apart:
            which = self.blockers.entering(origin, direction, np.full(1, limit, np.float32))
        if which is None or len(which) >= WORTH_CHOOSING * n:
            free = self.blockers.unoccluded(origin, direction, limit)
        else:
            free = np.ones(n, np.bool_)
            some = origin.take(which, axis=1), direction.take(which, axis=1)
            free[which] = self.blockers.unoccluded(*some, limit)
        stats.seconds += perf_counter() - start
        return free


@dataclass(frozen=True)
class MovingPackets(MovingAccelerator):
    """Static triangles and movers; origins are shifted as the course's own function does.

    Attributes
    ----------
    tables : of all
    numbers : (1 + K,) the first triangle of each
    """

    tables: SceneTables
    numbers: Indices

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
        """See ``MovingAccelerator``."""
        from course.compiled import moving_kernels

        assert time is not None
        start, n = perf_counter(), direction.shape[1]
        triangle, uvt = np.empty(n, np.int32), np.empty((3, n), np.float32)
        tables = self.tables
        moving_kernels.intersect(
            *(tables.scenes, tables.velocity, tables.boxes, self.numbers),
            *map(np.ascontiguousarray, (origin, direction, time)),
            *(COHERENT if coherent else 0, np.float32(NO_HIT), triangle, uvt),
        )
        stats.seconds += perf_counter() - start
        return Intersections(triangle, *uvt)

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
        """See ``MovingAccelerator``."""
        from course.compiled import moving_kernels

        assert time is not None
        start, free = perf_counter(), np.empty(direction.shape[1], np.bool_)
        tables = self.tables
        moving_kernels.unoccluded(
            *(tables.blockers, tables.velocity, tables.boxes),
            *map(np.ascontiguousarray, (origin, direction, time)),
            *(np.float32(limit), _ALL if active is None else active, free),
        )
        stats.seconds += perf_counter() - start
        return free


def in_packets(
    accelerator: Accelerator, parts: tuple[tuple[int, int, bool], ...] = ()
) -> Accelerator:
    """The same triangles, asked by packets; another hierarchy, that of bounding_volumes, as it is.

    ``parts``: of the objects that the triangles belong to, where they stand still: see ``Triangles``
    """
    if isinstance(accelerator, StaticAccelerator) and not isinstance(
        accelerator, PacketAccelerator
    ):
        return _packets(accelerator, parts, apart=False)
    if isinstance(accelerator, MovingAccelerator):
        movers = tuple(
            replace(mover, accelerator=_packets(mover.accelerator, (), apart=True))
            for mover in accelerator.movers
        )
        static = _packets(accelerator.static, (), apart=False)
        moving = replace(accelerator, static=static, movers=movers)
        motion_blur = accelerator.motion.motion_blur
        if not courses_own(motion_blur.to_object_space):
            return moving
        return _moving_packets(moving, static, movers)
    return accelerator


def _moving_packets(
    accelerator: MovingAccelerator, static: PacketAccelerator, movers: tuple[Mover, ...]
) -> MovingPackets:
    # Compiled here and not while rays are followed, which a time limit counts.
    from course.compiled import moving_kernels  # noqa: F401

    # What has no triangle is never asked.
    found = [
        (mover.accelerator.packets, mover.velocity, mover.first)
        for mover in movers
        if isinstance(mover.accelerator, PacketAccelerator) and mover.accelerator.packets
    ]
    return MovingPackets(
        **same_fields(accelerator),
        tables=SceneTables.of(static, [each[:2] for each in found]),
        numbers=np.array([0, *(first for _, _, first in found)], np.int64),
    )


def _packets(
    accelerator: StaticAccelerator, parts: tuple[tuple[int, int, bool], ...], apart: bool
) -> PacketAccelerator:
    if not len(accelerator.triangles):
        return PacketAccelerator(None)
    if accelerator not in _CONVEX:
        vertices, triangles = accelerator.vertices, accelerator.triangles
        _CONVEX[accelerator] = convex_objects(vertices, triangles, parts)
    blocking = accelerator.others if isinstance(accelerator, LampAccelerator) else accelerator
    packets, blockers = packets_of(accelerator), packets_of(blocking)
    return PacketAccelerator(packets, blockers, _CONVEX[accelerator], apart)
