"""Moving triangles that only those rays ask that may meet them.

Each mover has an Embree scene of its own, so without more ado a ray would ask as many as there are movers. A tree of
the boxes that they sweep while the shutter is open says which of them it may meet. Where a mover is at a time is what
the course's own ``to_object_space`` says: a student's function may move it anywhere, so there all are asked.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from course.engine.core.accelerator import Intersections, QueryStats
from course.engine.core.motion import MOSTLY_UNBLOCKED, MovingAccelerator
from course.engine.core.types import Floats32, Indices, Mask
from course.engine.core.vectors import repeated
from course.engine.terms.surfaces.boxes import BoxTree, box_tree, roomy_box


@dataclass(frozen=True)
class SweptMovers(MovingAccelerator):
    """Static triangles and movers, whose motion is that of the course's own functions."""

    @cached_property
    def tree(self) -> BoxTree | None:
        """Of the boxes that movers sweep; None if no mover has triangles."""
        there = [k for k, mover in enumerate(self.movers) if len(mover.accelerator.triangles)]
        boxes = np.zeros((len(self.movers), 2, 3), np.float32)
        for k in there:
            mover = self.movers[k]
            vertices = mover.accelerator.vertices
            boxes[k] = roomy_box(np.concatenate((vertices, vertices + mover.velocity)))
        return box_tree(boxes, np.array(there)) if there else None

    def _met(
        self, origin: Floats32, direction: Floats32, limit: Floats32, which: Indices
    ) -> list[tuple[int, Indices]]:
        """Movers and the rays (m,) of ``which`` that may meet them, in the order of their triangles."""
        tree = self.tree
        return [] if tree is None else sorted(tree.met(origin, direction, limit, which).items())

    def intersect(
        self,
        origin: Floats32,
        direction: Floats32,
        stats: QueryStats,
        time: Floats32 | None = None,
    ) -> Intersections:
        """See ``Accelerator.intersect``."""
        assert time is not None
        n = direction.shape[1]
        found = self.static.intersect(origin, direction, stats)
        origin = repeated(origin, n)
        for number, which in self._met(origin, direction, found.t, np.arange(n)):
            mover = self.movers[number]
            start, toward, when = _some(which, origin, direction, time)
            shifted = self._shifted(start, mover, when)
            other = mover.accelerator.intersect(shifted, toward, stats, limit=found.t.take(which))
            self.take(found, other, mover, which)
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
        n = direction.shape[1]
        free = self.static.unoccluded(origin, direction, limit, stats, active=active)
        if active is not None:
            free &= active
        origin, limits = repeated(origin, n), np.full(n, limit, np.float32)
        for number, which in self._met(origin, direction, limits, np.flatnonzero(free)):
            mover = self.movers[number]
            still_free = free.take(which)
            if np.count_nonzero(still_free) < MOSTLY_UNBLOCKED * len(which):
                which = which[still_free]
            if len(which) == 0:
                continue
            start, toward, when = _some(which, origin, direction, time)
            shifted = self._shifted(start, mover, when)
            free[which] &= mover.accelerator.unoccluded(shifted, toward, limit, stats)
        return free


def _some(which: Indices, origin: Floats32, direction: Floats32, time: Floats32) -> Any:
    """The rays ``which`` (m,): all arrays as they are where these are all."""
    arrays = origin, direction, time
    return arrays if len(which) == len(time) else [a.take(which, axis=-1) for a in arrays]
