"""The classic samplers: regular, random and jittered points, made by the course's `supersampling` module.

The student's function places the points in the pixel (dimensions 0 and 1). The other dimensions of a path get points
of the same kind from the engine, in an order of their own, because a light sampled in the pixel's order would only
ever pair the pixel's corner with the light's corner (Cook 1984, section 4.2).
"""

from __future__ import annotations

from collections.abc import Callable
from math import isqrt
from typing import TYPE_CHECKING

import numpy as np

from course.core.samplers.block import Block
from course.core.samplers.generator import generator
from course.core.types import Floats32

if TYPE_CHECKING:
    from numpy.random import Generator

Place = Callable[[int, int], Floats32]
"""supersampling.regular: (k, n) -> (2, n, k * k)."""

PlaceAtRandom = Callable[[int, int, "Generator"], Floats32]
"""supersampling.random and jittered: (k, n, rng) -> (2, n, k * k)."""

PIXEL = 0
"""The pixel's two dimensions are the first ones of every path."""


class RandomSampler:
    """Independent uniform numbers."""

    name = "random"
    extensible = True

    def __init__(self, seed: int, place: PlaceAtRandom) -> None:
        self._seed = seed
        self._place = place

    def draw(self, block: Block, dimension: int, width: int) -> Floats32:
        """See SobolSampler.draw."""
        rng = generator(self._seed, dimension, block)
        if dimension == PIXEL:
            k = isqrt(block.samples - 1) + 1
            points = self._place(k, len(block.pixels), rng)[..., : block.samples]
            return points.reshape(2, block.size)
        return rng.random((width, block.size), np.float32)


class JitteredSampler:
    """Stratified numbers: each sample of a pixel in a stratum of its own."""

    name = "jittered"
    extensible = False

    def __init__(self, seed: int, place: PlaceAtRandom) -> None:
        self._seed = seed
        self._place = place

    def draw(self, block: Block, dimension: int, width: int) -> Floats32:
        """See SobolSampler.draw; block.samples is a square number."""
        rng = generator(self._seed, dimension, block)
        k = isqrt(block.samples)
        n = len(block.pixels)
        if dimension == PIXEL:
            return self._place(k, n, rng).reshape(2, block.size)
        strata = np.arange(block.samples, dtype=np.float32)
        if width == 2:
            cell = rng.permuted(np.broadcast_to(strata, (n, block.samples)), axis=1)
            u = np.stack((cell % np.float32(k), cell // np.float32(k)))
            u += rng.random(u.shape, np.float32)
            u *= np.float32(1 / k)
        else:
            u = rng.permuted(np.broadcast_to(strata, (width, n, block.samples)), axis=2)
            u += rng.random(u.shape, np.float32)
            u *= np.float32(1 / block.samples)
        # u may have been rounded up to 1 in the last stratum.
        np.minimum(u, np.nextafter(np.float32(1), np.float32(0)), out=u)
        return u.reshape(width, block.size)


class RegularSampler:
    """Centres of equal cells, the same in every pixel: aliasing in its pure form."""

    name = "regular"
    extensible = False

    def __init__(self, seed: int, place: Place) -> None:
        self._seed = seed
        self._place = place

    def draw(self, block: Block, dimension: int, width: int) -> Floats32:
        """See SobolSampler.draw; block.samples is a square number."""
        k = isqrt(block.samples)
        n = len(block.pixels)
        if dimension == PIXEL:
            return self._place(k, n).reshape(2, block.size)
        strata = np.arange(block.samples)
        if block.samples > 1:
            # One order for the whole picture: whatever the grid misses, it misses in every pixel.
            rng = generator(self._seed, dimension, Block(block.pixels, 0, block.samples, 0))
            strata = rng.permuted(np.broadcast_to(strata, (width, block.samples)), axis=1)
        else:
            strata = np.broadcast_to(strata, (width, 1))
        if width == 2:
            cell = strata[0]
            points = np.stack(((cell % k + 0.5) / k, (cell // k + 0.5) / k))
        else:
            points = (strata + 0.5) / block.samples
        u = np.empty((width, n, block.samples), np.float32)
        u[:] = points[:, None, :]
        return u.reshape(width, block.size)
