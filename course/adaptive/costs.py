"""What samples cost, in camera rays that meet nothing.

Adaptive sampling puts fewer samples where each costs more (``course.adaptive.allocation``). Seconds would be what
counts, but they differ from run to run, and pictures mustn't.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np

from course.core.counters import Counters
from course.core.rays import Draws
from course.core.samplers import Block
from course.core.tiles import Area
from course.core.tracer import Tracer, never
from course.core.types import Floats32, Indices

HIT = 1.0
"""Finding out about a hit, and shading without lights."""

SHADOW_RAY = 1.5
"""A point on a light, and the ray towards it."""

FURTHER_RAY = 5.0
"""A ray on its way after a hit: they go anywhere, and camera rays go together."""


@dataclass(frozen=True)
class CostlyDraws(Draws):
    """Notes what paths cost.

    Attributes
    ----------
    cost : (paths,) float32, in which the cost of each path is added up
    """

    cost: Floats32 = field(kw_only=True)

    def cast(
        self,
        kind: str,
        n: int,
        path: Indices | None,
        which: Indices | None = None,
        cost: float | None = None,
    ) -> None:
        """See ``Draws``."""
        super().cast(kind, n, path, which, cost)
        if cost is None:
            cost = SHADOW_RAY if kind == "shadow" else FURTHER_RAY
        if which is not None:
            path = which if path is None else path.take(which)
        self._spend(cost, path)

    def hit(self, path: Indices | None) -> None:
        """See ``Draws``."""
        self._spend(HIT, path)

    def _spend(self, each: float, path: Indices | None) -> None:
        cost = self.cost
        if path is None:
            cost += np.float32(each)
        else:
            np.add.at(cost, path, np.float32(each))

    def part(self, block: Block, paths: slice) -> Draws:
        """See ``Draws``."""
        return replace(self, block=block, cost=self.cost[paths])


@dataclass(frozen=True)
class CostlyTracer(Tracer):
    """A tracer that says what samples cost."""

    def render_tile(
        self,
        tile: Area,
        first: int,
        samples: int,
        counters: Counters,
        cancelled: Callable[[], bool] = never,
        parts: int = 1,
    ) -> tuple[Floats32, Floats32 | float]:
        """See ``Tracer``; with several parts (4, n * parts) numbers, below the colours the cost of a sample."""
        if parts == 1:
            return super().render_tile(tile, first, samples, counters, cancelled, parts)
        cost = np.ones(tile.size * samples, np.float32)
        noted = _Noting(**vars(self), cost=cost)
        mean, weight = super(CostlyTracer, noted).render_tile(
            tile, first, samples, counters, cancelled, parts
        )
        # The same for all parts: sums of a few numbers each would take longer than what they are good for.
        each = cost.reshape(tile.size, samples).mean(axis=1)
        return np.concatenate((mean, np.repeat(each, parts)[None])), weight


@dataclass(frozen=True)
class _Noting(CostlyTracer):
    """For one tile."""

    cost: Floats32 = field(kw_only=True)

    def draws(self, block: Block, counters: Counters, cancelled: Callable[[], bool]) -> Draws:
        """See ``Tracer``."""
        return CostlyDraws(
            self.sampler, self.dimensions, block, counters, cancelled, cost=self.cost
        )
