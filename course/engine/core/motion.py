"""Moving triangles: each velocity has its own Embree scene, and ray origins are shifted into its frame.

embreex has no motion blur. Instead of moving an object by d, the ray's origin is moved by -d: the ray hits the same
point of the object. A translation preserves directions; see the module `motion_blur`. Static triangles are numbered
first, then those of each mover.
"""

from dataclasses import dataclass

import numpy as np

from course.engine.core.accelerator import Intersections, QueryStats, StaticAccelerator
from course.engine.core.types import Floats32, Functions, Indices, Mask, Numbers
from course.engine.core.vectors import repeated

MOSTLY_UNBLOCKED = 0.9
"""If at least this share of the rays is unblocked, testing all rays is cheaper than copying the unblocked ones."""


@dataclass(frozen=True)
class Motion:
    """Motion while the shutter is open; ``camera_velocity`` (3,) float32 [units of the compiled scene / exposure]."""

    motion_blur: Functions
    camera_velocity: Floats32 | None = None

    def moved(self, velocity: Floats32, time: Floats32) -> Floats32:
        """Displacement (3, N) float32 at times (N,)."""
        displacement: Floats32 = self.motion_blur.displacement(velocity, time)
        return displacement


@dataclass(frozen=True)
class Mover:
    """Triangles first .. last - 1, with velocity (3,) float32 [units of the compiled scene / exposure]."""

    velocity: Floats32
    accelerator: StaticAccelerator
    first: int
    last: int


@dataclass(frozen=True)
class MovingAccelerator:
    """Static triangles and movers; see ``course.engine.core.accelerator.Accelerator``."""

    static: StaticAccelerator
    movers: tuple[Mover, ...]
    motion: Motion

    def intersect(
        self,
        origin: Floats32,
        direction: Floats32,
        stats: QueryStats,
        time: Floats32 | None = None,
    ) -> Intersections:
        """See ``Accelerator.intersect``."""
        assert time is not None
        found = self.static.intersect(origin, direction, stats)
        origin = repeated(origin, direction.shape[1])
        for mover in self.movers:
            shifted = self._shifted(origin, mover, time)
            other = mover.accelerator.intersect(shifted, direction, stats, limit=found.t)
            self.take(found, other, mover)
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
        assert time is not None
        free = self.static.unoccluded(origin, direction, limit, stats, active=active)
        if active is not None:
            free &= active
        origin = repeated(origin, direction.shape[1])
        for mover in self.movers:
            unblocked = np.flatnonzero(free)
            if len(unblocked) == 0:
                break
            start, toward, when = origin, direction, time
            if len(unblocked) < MOSTLY_UNBLOCKED * len(free):
                start, toward = origin.take(unblocked, axis=1), direction.take(unblocked, axis=1)
                when = time.take(unblocked)
            else:
                unblocked = np.arange(len(free))
            shifted = self._shifted(start, mover, when)
            free[unblocked] &= mover.accelerator.unoccluded(shifted, toward, limit, stats)
        return free

    @staticmethod
    def take(
        found: Intersections, other: Intersections, mover: Mover, which: Indices | None = None
    ) -> None:
        """Copy a mover's hits ``other``, all nearer, into ``found``; ``which`` (n,): their rays, None for all."""
        hit = np.flatnonzero(other.triangle >= 0)
        nearer = hit if which is None else which.take(hit)
        found.triangle[nearer] = other.triangle.take(hit) + np.int32(mover.first)
        for mine, theirs in ((found.u, other.u), (found.v, other.v), (found.t, other.t)):
            mine[nearer] = theirs.take(hit)

    def _shifted(self, origin: Floats32, mover: Mover, time: Floats32) -> Floats32:
        """Origins (3, N) in the mover's frame."""
        shifted: Floats32 = self.motion.motion_blur.to_object_space(origin, mover.velocity, time)
        return shifted

    def follow(self, points: Floats32, triangle: Numbers, time: Floats32) -> None:
        """Move points (3, n) with their triangles from time 0 to ``time`` (n,), in place."""
        for mover in self.movers:
            which = np.flatnonzero((triangle >= mover.first) & (triangle < mover.last))
            if len(which):
                points[:, which] += self.motion.moved(mover.velocity, time.take(which))
