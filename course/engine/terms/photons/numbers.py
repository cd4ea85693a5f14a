"""Random numbers of photons: each pass has its own, and in a pass they are spread evenly."""

import numpy as np

from course.engine.core.rays import Draws
from course.engine.core.samplers import Block, Sampler
from course.engine.core.types import Floats32, Indices

PHOTONS = 0x70686F74
"""Keeps the generators of photons apart from those of paths with the same seed."""

_TO_UNIT = 2.0**-24


class PhotonSampler(Sampler):
    """Numbers of photons that mirrors and glass ask for; a block is of one pass, its part a batch of this."""

    name = "photons"
    extensible = True

    def __init__(self, seed: int) -> None:
        self.seed = seed

    def draw(self, block: Block, dimension: int, width: int) -> Floats32:
        """See ``Sampler``."""
        rng = np.random.default_rng((PHOTONS, self.seed, dimension, block.part, block.first))
        return rng.random((width, block.size), np.float32)

    def draw_some(self, block: Block, dimension: int, width: int, path: Indices) -> Floats32:
        """See ``Sampler``."""
        return self.draw(block, dimension, width).take(path, axis=1)


def seed_of(draws: Draws) -> int:
    """What the render's seed has made its sampler say first: photons hang on it, too."""
    sampler = draws.sampler
    block = Block(np.zeros(1, np.uint32), 0, 1 if sampler.extensible else draws.block.samples, 0)
    words = np.ascontiguousarray(sampler.draw(block, 2, 2)[:, :1]).view(np.uint32)
    return int(words[0, 0]) << 32 | int(words[1, 0])


def spread(seed: int, number: int, first: int, n: int, width: int) -> Floats32:
    """Numbers (width, n) of photons from ``first`` on: Kronecker's sequence, shifted at random for each pass.

    M. Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018.
    """
    # The root of x^(width + 1) = x + 1, by iteration.
    root = 2.0
    for _ in range(60):
        root = (1 + root) ** (1 / (width + 1))
    steps = np.array([int(2**64 / root ** (k + 1)) for k in range(width)], np.uint64)
    rng = np.random.default_rng((PHOTONS, seed, number))
    shift = rng.integers(0, 2**64, width, np.uint64)
    index = np.arange(first, first + n, dtype=np.uint64)
    words = shift[:, None] + steps[:, None] * index
    u: Floats32 = ((words >> np.uint64(40)) * _TO_UNIT).astype(np.float32)
    return u
