"""A stream of random numbers for each pixel, made by the course's `sampling` module."""

import numpy as np

from course.engine.core.samplers import Block, Sampler
from course.engine.core.types import Floats32, Functions
from course.engine.terms.samplers.hashing import combine, hash_words


class XorshiftSampler(Sampler):
    """Independent numbers: each pixel has a stream for each dimension, and sample i takes its i-th number.

    Where a stream begins is a hash of seed, dimension, pixel and first sample. So streams need not be kept, and a pixel
    has its numbers in any block.
    """

    name = "xorshift"
    extensible = True

    def __init__(self, seed: int, sampling: Functions) -> None:
        self._seed = seed
        self._sampling = sampling

    def draw(self, block: Block, dimension: int, width: int) -> Floats32:
        """See Sampler.draw."""
        salts = [combine(self._seed, dimension + row, block.first) for row in range(width)]
        state = hash_words(block.pixels, *salts).ravel()
        # 0 stays 0 for ever.
        state[state == 0] = 1
        u = np.empty((block.samples, len(state)), np.float32)
        for sample in range(block.samples):
            state, u[sample] = self._sampling.xorshift32(state)
        return np.ascontiguousarray(u.T).reshape(width, block.size)
