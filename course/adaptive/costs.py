"""What samples cost, in camera rays that meet nothing.

Adaptive sampling puts fewer samples where each costs more (``course.adaptive.allocation``). Seconds would be what
counts, but they differ from run to run, and pictures mustn't.
"""

from __future__ import annotations

import numpy as np

from course.core.types import Floats32, Indices

HIT = 1.0
"""Finding out about a hit, and shading without lights."""

SHADOW_RAY = 1.5
"""A point on a light, and the ray towards it."""

FURTHER_RAY = 5.0
"""A ray on its way after a hit: they go anywhere, and camera rays go together."""


class RowOfCosts:
    """The costs of a block's paths; see ``course.core.rays.PathCosts``."""

    def __init__(self, cost: Floats32) -> None:
        self._cost = cost

    @classmethod
    def of(cls, paths: int) -> RowOfCosts:
        """The costs of so many camera rays."""
        return cls(np.ones(paths, np.float32))

    def add(self, kind: str, path: Indices | None, cost: float | None = None) -> None:
        """See ``PathCosts``."""
        if cost is None:
            cost = {"hit": HIT, "shadow": SHADOW_RAY}.get(kind, FURTHER_RAY)
        if path is None:
            self._cost += np.float32(cost)
        else:
            np.add.at(self._cost, path, np.float32(cost))

    def part(self, paths: slice) -> RowOfCosts:
        """See ``PathCosts``."""
        return RowOfCosts(self._cost[paths])

    def with_row(self, mean: Floats32, parts: int) -> Floats32:
        """See ``PathCosts``; the same for all parts: sums of few numbers each would take more time than they spare."""
        pixels = mean.shape[1] // parts
        each = self._cost.reshape(pixels, -1).mean(axis=1)
        return np.concatenate((mean, np.repeat(each, parts)[None]))
