"""The engine's default: one Sobol dimension for each dimension of the path, scrambled by the pixel.

The first n points are the same whether n or 2n are asked for, so that a picture can be continued.
"""

from __future__ import annotations

import numpy as np

from course.core.hashing import combine, hash_words
from course.core.samplers.block import Block
from course.core.sobol import DIMENSIONS, sobol_words
from course.core.types import Floats32

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
        u = np.empty((width, len(block.pixels), block.samples), np.float32)
        for row in range(width):
            number = dimension + row
            words = _words(number, block)
            scramble = hash_words(block.pixels, combine(self._seed, number))
            mixed = words ^ scramble[:, None]
            mixed >>= np.uint32(8)
            np.multiply(mixed, _TO_UNIT, out=u[row], casting="unsafe")
        return u.reshape(width, block.size)


def _words(dimension: int, block: Block) -> np.ndarray[tuple[int], np.dtype[np.uint32]]:
    if dimension < DIMENSIONS:
        return sobol_words(dimension, block.first, block.samples)
    # Beyond the table: independent random words, one a sample; stratification matters least so deep in a path.
    index = np.arange(block.first, block.first + block.samples, dtype=np.uint32)
    return hash_words(index, combine(dimension))
