"""Moving triangles: each group that moves alike has an Embree scene of its own, and rays are shifted into its frame.

embreex has no motion. But an object that moves by d looks from the ray's side as if it stood still and the ray's
origin had moved by -d; directions don't change under translation (the `motion_blur` module). Triangles are numbered
through: first the static ones, then those of each mover.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from course.core.types import Floats32, Mask, Numbers
from course.geometry.convex import ConvexObjects, Objects
from course.geometry.embree import Accelerator, Intersections, QueryTime

ToObjectSpace = Callable[[Floats32, Floats32, Floats32], Floats32]
Displacement = Callable[[Floats32, Floats32], Floats32]


@dataclass(frozen=True)
class Mover:
    """Triangles first .. last - 1, which move with one velocity (3,) float32 [1 / exposure]."""

    velocity: Floats32
    accelerator: Accelerator
    first: int
    last: int


NEARLY_ALL = 0.9
"""The share of rays above which a query of all is cheaper than copies of those that are left."""


@dataclass(frozen=True)
class MovingAccelerator:
    """Static triangles and movers behind ``course.geometry.accelerators.AnyAccelerator``.

    Attributes
    ----------
    to_object_space, displacement : the functions of the motion_blur module
    """

    static: Accelerator
    movers: tuple[Mover, ...]
    to_object_space: ToObjectSpace
    displacement: Displacement

    @property
    def convex(self) -> ConvexObjects | None:
        """None: what leaves one object may still meet another where things move."""
        return None

    def use_packets(self, wanted: bool) -> None:
        """See ``AnyAccelerator.use_packets``."""
        for accelerator in (self.static, *(mover.accelerator for mover in self.movers)):
            accelerator.use_packets(wanted)

    @property
    def compiled(self) -> bool:
        """Whether one of them uses compiled loops."""
        return self.static.compiled or any(mover.accelerator.compiled for mover in self.movers)

    def intersect(
        self,
        origin: Floats32,
        direction: Floats32,
        clock: QueryTime,
        time: Floats32 | None,
        coherent: bool = False,
        left: Objects | None = None,
    ) -> Intersections:
        """Nearest hits at the rays' times (N,); see ``AnyAccelerator.intersect``."""
        assert time is not None
        found = self.static.intersect(origin, direction, clock, coherent=coherent)
        origin = _each_its_own(origin, direction.shape[1])
        for mover in self.movers:
            shifted = self.to_object_space(origin, mover.velocity, time)
            which = mover.accelerator.entering(shifted, direction, found.t, clock)
            if which is None:
                there, limit = direction, found.t
            else:
                shifted, there = shifted.take(which, axis=1), direction.take(which, axis=1)
                limit = found.t.take(which)
            other = mover.accelerator.intersect(
                shifted, there, clock, limit=limit, coherent=coherent
            )
            nearer = np.flatnonzero(other.triangle >= 0)
            if len(nearer) == 0:
                continue
            into = nearer if which is None else which.take(nearer)
            found.triangle[into] = other.triangle.take(nearer) + np.int32(mover.first)
            for mine, theirs in ((found.u, other.u), (found.v, other.v), (found.t, other.t)):
                mine[into] = theirs.take(nearer)
        return found

    def unoccluded(
        self,
        origin: Floats32,
        direction: Floats32,
        limit: float,
        clock: QueryTime,
        time: Floats32 | None,
        asked: Mask | None = None,
    ) -> Mask:
        """Whether the way is free at the rays' times; see ``AnyAccelerator.unoccluded``."""
        assert time is not None
        free = self.static.unoccluded(origin, direction, limit, clock, asked=asked)
        if asked is not None:
            free &= asked
        origin = _each_its_own(origin, direction.shape[1])
        for mover in self.movers:
            # Only those that nothing has blocked so far are asked again, unless copies of them would be of nearly all.
            left = np.flatnonzero(free)
            if len(left) == 0:
                break
            start, toward, when = origin, direction, time
            if len(left) < NEARLY_ALL * len(free):
                start, toward = origin.take(left, axis=1), direction.take(left, axis=1)
                when = time.take(left)
            else:
                left = np.arange(len(free))
            shifted = self.to_object_space(start, mover.velocity, when)
            which = mover.accelerator.entering(
                shifted, toward, np.full(1, limit, np.float32), clock
            )
            if which is not None:
                left = left.take(which)
                shifted, toward = shifted.take(which, axis=1), toward.take(which, axis=1)
            free[left] &= mover.accelerator.unoccluded(shifted, toward, limit, clock)
        return free

    def follow(self, points: Floats32, triangle: Numbers, time: Floats32) -> None:
        """Move points (3, n) on triangles to where those are at their times, in place."""
        for mover in self.movers:
            which = np.flatnonzero((triangle >= mover.first) & (triangle < mover.last))
            if len(which):
                points[:, which] += self.displacement(mover.velocity, time.take(which))


def _each_its_own(origin: Floats32, n: int) -> Floats32:
    return origin if origin.shape[1] == n else np.repeat(origin, n, axis=1)
