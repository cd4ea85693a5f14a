"""An accelerator that keeps the last shadow rays, so that it can be told what blocks them."""

from typing import Any

import numpy as np

from course.engine.core.accelerator import QueryStats
from course.engine.core.types import Floats32, Indices, Mask


class Asking:
    """An accelerator that keeps the last shadow rays, with what blocks them."""

    def __init__(self, accelerator: Any) -> None:
        self._accelerator = accelerator
        # Origins, directions, limit, whether they were free, and times.
        self.last: Any = None
        self.muted = False

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
        """See ``Accelerator``."""
        free: Mask = self._accelerator.unoccluded(
            origin, direction, limit, stats, time, active=active
        )
        self.last = origin.copy(), direction.copy(), limit, free.copy(), time
        return free

    def blockers(self, which: Indices) -> tuple[Floats32, Floats32, Floats32, Indices]:
        """Origins, directions (3, m), distances (m,) of what blocks them, and its triangles (m,), -1 for none."""
        origin, direction, limit, _, time = self.last
        origin, direction = origin.take(which, axis=1), direction.take(which, axis=1)
        self.muted = True
        when = None if time is None else time.take(which)
        found = self._accelerator.intersect(origin, direction, QueryStats(), when)
        self.muted = False
        blocked = (found.triangle >= 0) & (found.t < limit)
        return origin, direction, found.t, np.where(blocked, found.triangle, -1)
