"""Rays on their way, and the numbers that their paths draw."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np

from course.core.samplers import Block, Sampler
from course.core.samplers.sobol import SobolSampler
from course.core.types import Floats32, Indices, Media
from course.geometry.convex import Objects
from course.transport.counters import Counters

OPEN = np.int16(-1)
"""The medium of rays that travel in no dielectric."""


@dataclass(frozen=True)
class Rays:
    """A batch of rays, one column a ray.

    Attributes
    ----------
    origin : (3, n) float32, or (3, 1) if they share it
    direction : (3, n) float32, unit length
    throughput : (3, n) float32, how much of what a ray brings reaches the film; None means all of it
    path : (n,) number of the path in the block; None means one ray for each path, in order
    time : (n,) float32 since the shutter opened, in exposures; None where nothing moves
    medium : (n,) int16, material that the ray travels in, OPEN outside; None where nothing absorbs, and for camera rays
    left : (n,) int8, the convex object that a ray leaves for good, -1 for none; None where nobody asks
    start : (3, n) float32, the hit that a ray leaves, beside which its origin lies; None where nothing absorbs, and for
        camera rays
    """

    origin: Floats32
    direction: Floats32
    throughput: Floats32 | None
    path: Indices | None
    medium: Media | None = None
    time: Floats32 | None = None
    left: Objects | None = None
    start: Floats32 | None = None

    @property
    def size(self) -> int:
        """Number of rays."""
        return int(self.direction.shape[1])

    def halves(self) -> tuple[Rays, Rays]:
        """The second and the first half, each a batch of its own."""
        middle = self.size // 2
        rays = self if self.path is not None else replace(self, path=np.arange(self.size))
        return rays.part(slice(middle, None)), rays.part(slice(middle))

    def part(self, columns: slice) -> Rays:
        """Some of the rays; where all have one for each path, in order, so have these."""
        return Rays(
            self.origin if self.origin.shape[1] == 1 else self.origin[:, columns],
            self.direction[:, columns],
            None if self.throughput is None else self.throughput[:, columns],
            None if self.path is None else self.path[columns],
            None if self.medium is None else self.medium[columns],
            None if self.time is None else self.time[columns],
            None if self.left is None else self.left[columns],
            None if self.start is None else self.start[:, columns],
        )


@dataclass(frozen=True)
class Draws:
    """Draws the numbers of a block's paths, those that are asked for and no others, and notes what paths cost.

    Attributes
    ----------
    compiled : whether compiled loops are used
    cost : (paths,) float32, in which the cost of each path is added up; None where nobody asks
    """

    sampler: Sampler
    block: Block
    counters: Counters
    cancelled: Callable[[], bool]
    compiled: bool = False
    cost: Floats32 | None = None

    def part(self, block: Block, paths: slice) -> Draws:
        """The same for some pixels of the block, to which some of its paths belong."""
        return replace(self, block=block, cost=None if self.cost is None else self.cost[paths])

    def spend(self, each: float, path: Indices | None, which: Indices | None = None) -> None:
        """Add to the cost of the paths of some rays.

        Parameters
        ----------
        each : cost of a ray, in the unit of ``course.transport.costs``
        path : (n,) of each ray; None for one ray for each path, in order
        which : (m,) of the rays; None for all
        """
        cost = self.cost
        if cost is None:
            return
        if which is not None:
            path = which if path is None else path.take(which)
        if path is None:
            cost += np.float32(each)
        else:
            np.add.at(cost, path, np.float32(each))

    def __call__(self, name: str, dimension: int, width: int, path: Indices | None) -> Floats32:
        """(width, n) numbers for the given paths, or for all paths of the block."""
        if path is None:
            u = self.sampler.draw(self.block, dimension, width)
        elif isinstance(self.sampler, SobolSampler):
            if self.compiled and dimension % 2 + width <= 2:
                u = self._by_loop(dimension, width, path)
            else:
                u = self.sampler.draw_some(self.block, dimension, width, path)
        else:
            u = self.sampler.draw(self.block, dimension, width).take(path, axis=1)
        self.counters.drew(name, u.size)
        return u

    def _by_loop(self, dimension: int, width: int, path: Indices) -> Floats32:
        """What ``SobolSampler.draw_some`` draws, to the same bits."""
        from course.transport import draw_kernels

        assert isinstance(self.sampler, SobolSampler)
        points, salts = self.sampler.pair(self.block, dimension // 2)
        u = np.empty((width, len(path)), np.float32)
        draw_kernels.draw(
            *(np.ascontiguousarray(self.block.pixels), self.block.samples),
            *(np.ascontiguousarray(path), points, np.array(salts, np.uint64), dimension % 2, u),
        )
        return u


def together(reflected: Rays | None, refracted: Rays | None) -> Rays | None:
    """Both kinds in one batch: one large batch costs less than two small ones."""
    if reflected is None or refracted is None:
        return reflected or refracted
    return joined([reflected, refracted])


def joined(batches: Sequence[Rays]) -> Rays:
    """Several batches as one; what one of them has, all have."""

    def columns(name: str) -> Any:
        arrays = [getattr(rays, name) for rays in batches]
        return None if arrays[0] is None else np.concatenate(arrays, axis=-1)

    return Rays(*(columns(field.name) for field in fields(Rays)))
