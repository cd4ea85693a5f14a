"""Rays on their way, and the numbers that their paths draw."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from course.core.samplers import Block, Sampler
from course.core.samplers.sobol import SobolSampler
from course.core.types import Floats32, Indices, Media
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
    """

    origin: Floats32
    direction: Floats32
    throughput: Floats32 | None
    path: Indices | None
    medium: Media | None = None
    time: Floats32 | None = None

    @property
    def size(self) -> int:
        """Number of rays."""
        return int(self.direction.shape[1])

    def halves(self) -> tuple[Rays, Rays]:
        """The second and the first half, each a batch of its own."""
        middle = self.size // 2
        path = np.arange(self.size) if self.path is None else self.path

        def part(columns: slice) -> Rays:
            return Rays(
                self.origin if self.origin.shape[1] == 1 else self.origin[:, columns],
                self.direction[:, columns],
                None if self.throughput is None else self.throughput[:, columns],
                path[columns],
                None if self.medium is None else self.medium[columns],
                None if self.time is None else self.time[columns],
            )

        return part(slice(middle, None)), part(slice(middle))


@dataclass(frozen=True)
class Draws:
    """Draws the numbers of a block's paths, those that are asked for and no others."""

    sampler: Sampler
    block: Block
    counters: Counters
    cancelled: Callable[[], bool]

    def __call__(self, name: str, dimension: int, width: int, path: Indices | None) -> Floats32:
        """(width, n) numbers for the given paths, or for all paths of the block."""
        if path is None:
            u = self.sampler.draw(self.block, dimension, width)
        elif isinstance(self.sampler, SobolSampler):
            u = self.sampler.draw_some(self.block, dimension, width, path)
        else:
            u = self.sampler.draw(self.block, dimension, width).take(path, axis=1)
        self.counters.drew(name, u.size)
        return u


def together(reflected: Rays | None, refracted: Rays | None) -> Rays | None:
    """Both kinds in one batch: one large batch costs less than two small ones."""
    if reflected is None or refracted is None:
        return reflected or refracted
    a, b = reflected, refracted
    assert a.throughput is not None
    assert b.throughput is not None
    assert a.path is not None
    assert b.path is not None
    medium = None
    if a.medium is not None and b.medium is not None:
        medium = np.concatenate((a.medium, b.medium))
    return Rays(
        np.concatenate((a.origin, b.origin), axis=1),
        np.concatenate((a.direction, b.direction), axis=1),
        np.concatenate((a.throughput, b.throughput), axis=1),
        np.concatenate((a.path, b.path)),
        medium,
        None if a.time is None or b.time is None else np.concatenate((a.time, b.time)),
    )
