"""The engine's default: one Sobol dimension for each dimension of the path, scrambled by the pixel.

The first n points are the same whether n or 2n are asked for, so that a picture can be continued.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from course.core.hashing import combine, hash_words
from course.core.samplers.block import Block
from course.core.sobol import DIMENSIONS, sobol_words
from course.core.types import Floats32, Words

_TO_UNIT = np.float32(2.0**-24)


class SobolSampler:
    """u = Sobol word of the sample, exclusive-or a hash of (seed, dimension, pixel)."""

    name = "sobol"
    extensible = True

    def __init__(self, seed: int) -> None:
        self._seed = seed

    def draw(self, block: Block, dimension: int, width: int) -> Floats32:
        """Numbers for ``width`` consecutive dimensions.

        Returns
        -------
        (width, block.size) float32 in [0, 1); the top 24 bits, so that none rounds up to 1.
        """
        dimensions = range(dimension, dimension + width)
        scramble = hash_words(block.pixels, *(combine(self._seed, number) for number in dimensions))
        mixed = _words(dimension, width, block.first, block.samples) ^ scramble[:, :, None]
        mixed >>= np.uint32(8)
        u: Floats32 = np.multiply(mixed, _TO_UNIT, dtype=np.float32)
        return u.reshape(width, block.size)


@lru_cache(maxsize=4096)
def _words(dimension: int, width: int, first: int, samples: int) -> Words:
    """(width, 1, samples) uint32 words of a stretch of samples, the same for every pixel."""
    rows = []
    for number in range(dimension, dimension + width):
        if number < DIMENSIONS:
            rows.append(sobol_words(number, first, samples))
        else:
            # Beyond the table, independent words: so deep in a path stratification matters least.
            index = np.arange(first, first + samples, dtype=np.uint32)
            rows.append(hash_words(index, combine(number))[0])
    return np.stack(rows)[:, None, :]
