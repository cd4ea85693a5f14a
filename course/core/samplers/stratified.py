"""The classic samplers: random, jittered and regular points.

The functions of `supersampling` place the points in the pixel (dimensions 0 and 1). The other dimensions of a path have
points of the same kind, each in its own random order. Otherwise the sample in the pixel's corner would always get the
point in the light's corner (Cook 1984, section 4.2).
"""

from __future__ import annotations

from math import isqrt

import numpy as np

from course.core.functions import Functions
from course.core.samplers import Block, Sampler, generator
from course.core.types import Floats32

PIXEL = 0
"""First of the pixel's two dimensions."""


class _ClassicSampler(Sampler):
    def __init__(self, seed: int, supersampling: Functions) -> None:
        self._seed = seed
        self._supersampling = supersampling


class RandomSampler(_ClassicSampler):
    """Independent uniform numbers."""

    name = "random"
    extensible = True

    def draw(self, block: Block, dimension: int, width: int) -> Floats32:
        """See Sampler.draw."""
        rng = generator(self._seed, dimension, block)
        if dimension == PIXEL:
            k = isqrt(block.samples - 1) + 1
            points: Floats32 = self._supersampling.random(k, len(block.pixels), rng)
            return points[..., : block.samples].reshape(2, block.size)
        return rng.random((width, block.size), np.float32)


class JitteredSampler(_ClassicSampler):
    """Stratified numbers: one sample of a pixel per stratum."""

    name = "jittered"
    extensible = False

    def draw(self, block: Block, dimension: int, width: int) -> Floats32:
        """See Sampler.draw; block.samples is a square number."""
        rng = generator(self._seed, dimension, block)
        k = isqrt(block.samples)
        n = len(block.pixels)
        if dimension == PIXEL:
            points: Floats32 = self._supersampling.jittered(k, n, rng)
            return points.reshape(2, block.size)
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


class RegularSampler(_ClassicSampler):
    """Centres of equal strata, the same in every pixel: pure aliasing."""

    name = "regular"
    extensible = False

    def draw(self, block: Block, dimension: int, width: int) -> Floats32:
        """See Sampler.draw; block.samples is a square number."""
        k = isqrt(block.samples)
        n = len(block.pixels)
        if dimension == PIXEL:
            centers: Floats32 = self._supersampling.regular(k, n)
            return centers.reshape(2, block.size)
        strata = np.arange(block.samples)
        if block.samples > 1:
            # The same order in all pixels: the error is the same in all, and seen as aliasing.
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
