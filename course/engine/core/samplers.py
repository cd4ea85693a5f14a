"""Samplers draw the numbers in [0, 1) that paths use. Here are the classic ones: random, jittered and regular.

A block holds the same range of samples of several pixels. Path p of a block is sample ``first + p % samples`` of its
pixel ``p // samples``. So an array (paths,), reshaped to (pixels, samples), has one row per pixel.

A classic sampler places its points in the pixel (dimensions 0 and 1) by the functions of `supersampling`. In the
other dimensions it has points of the same kind, shuffled independently. Without the shuffle, the sample in the corner
of the pixel would always use the point in the corner of the light (R. Cook, "Stochastic sampling in computer
graphics", 1986).
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import cached_property
from math import isqrt

import numpy as np

from course.engine.core.types import Floats32, Functions, Indices, Words

PIXEL = 0
"""First of the two dimensions for the point in the pixel."""


@dataclass(frozen=True)
class Block:
    """The paths of some samples of some pixels, such as one pass of a tile.

    Attributes
    ----------
    pixels : (n,) uint32, number of each pixel in the picture, row by row
    first : number of the first sample of each pixel
    samples : number of samples of each pixel
    part : number of the tile; it enters the seeds of the generators
    """

    pixels: Words
    first: int
    samples: int
    part: int

    @cached_property
    def size(self) -> int:
        """Number of paths: pixels times samples."""
        return len(self.pixels) * self.samples


class Sampler(ABC):
    """Draws numbers for the paths of a block; blocks may come in any order.

    Scene files know it by its ``name``. ``extensible`` is true if n samples can be extended to 2n.
    """

    name: str
    extensible: bool

    @abstractmethod
    def draw(self, block: Block, dimension: int, width: int) -> Floats32:
        """Numbers in [0, 1) for ``width`` dimensions from ``dimension`` on, (width, block.size) float32."""

    def draw_some(self, block: Block, dimension: int, width: int, path: Indices) -> Floats32:
        """The columns of ``draw`` for paths (m,)."""
        return self.draw(block, dimension, width).take(path, axis=1)


# The result's type is in quotes, so that numpy.random isn't imported with this file.
def generator(seed: int, dimension: int, block: Block) -> "np.random.Generator":
    """A new NumPy generator for one dimension of one block."""
    return np.random.default_rng((seed, dimension, block.part, block.first))


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
        k, n = isqrt(block.samples), len(block.pixels)
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
        k, n = isqrt(block.samples), len(block.pixels)
        if dimension == PIXEL:
            centers: Floats32 = self._supersampling.regular(k, n)
            return centers.reshape(2, block.size)
        # The order is the same in all pixels, so all have the same error, which shows as aliasing.
        rng = generator(self._seed, dimension, Block(block.pixels, 0, block.samples, 0))
        strata = np.broadcast_to(np.arange(block.samples), (width, block.samples))
        strata = rng.permuted(strata, axis=1)
        if width == 2:
            cell = strata[0]
            points = np.stack(((cell % k + 0.5) / k, (cell // k + 0.5) / k))
        else:
            points = (strata + 0.5) / block.samples
        u = np.empty((width, n, block.samples), np.float32)
        u[:] = points[:, None, :]
        return u.reshape(width, block.size)
