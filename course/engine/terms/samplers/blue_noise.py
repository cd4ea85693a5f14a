"""Points whose error is spread over the picture like blue noise, made by the course's `blue_noise` module.

A pixel's numbers depend on the seed, its place and the number of samples alone, and not on the block that it is in.
"""

from abc import abstractmethod
from functools import cache, cached_property

import numpy as np

from course.engine.core.samplers import Block, Sampler
from course.engine.core.types import Floats32, Functions, Indices, Words
from course.engine.terms.samplers.hashing import combine, hash_words
from course.engine.terms.samplers.sobol import TO_UNIT, owen_scrambled, sobol_words

MASK = 64
"""Pixels along a side of the mask."""

SIGMA = 1.9
"""Width of a point of the mask [pixels]; Ulichney found 1.5 for his, and somewhat wider ones repeat less."""

_CURVE, _SCRAMBLE, _PAIRING, _MASK_SHIFT, _START = range(16, 21)
"""Salts: what a hash decides."""

_MASK32 = (1 << 32) - 1


class _Pairwise(Sampler):
    """Each pair of dimensions has points of its own."""

    extensible = False

    def __init__(self, seed: int, blue_noise: Functions, size: tuple[int, int]) -> None:
        self._seed = seed
        self._blue_noise = blue_noise
        self._width, self._height = size

    def draw(self, block: Block, dimension: int, width: int) -> Floats32:
        """See Sampler.draw; block.samples are all samples of the pixel."""
        pairs = range(dimension // 2, (dimension + width - 1) // 2 + 1)
        y, x = np.divmod(block.pixels.astype(np.int64), self._width)
        found = np.concatenate([self._pair(x, y, block.samples, pair) for pair in pairs])
        first = dimension % 2
        return found[first : first + width].reshape(width, block.size)

    @abstractmethod
    def _pair(self, x: Indices, y: Indices, samples: int, pair: int) -> Floats32:
        """Numbers (2, n, samples) of a pair of dimensions for pixels in columns x and rows y, (n,)."""

    def _salt(self, *keys: int) -> int:
        return combine(self._seed, *keys)

    def _scrambled(self, index: Words, pair: int) -> Floats32:
        """Points (2, ...) of Sobol's sequence, scrambled for the pair."""
        seeds = [self._salt(_SCRAMBLE, pair, row) & _MASK32 for row in range(2)]
        shape = (2, *[1] * index.ndim)
        words = owen_scrambled(sobol_words(index), np.array(seeds, np.uint32).reshape(shape))
        # 24 bits, so that no number rounds up to 1.
        u: Floats32 = np.multiply(words >> np.uint32(8), TO_UNIT, dtype=np.float32)
        return u


class BlueNoiseSampler(_Pairwise):
    """Pixels take stretches of one sequence in a shuffled Z-order, so all quadrants have stratified points.

    The order is another one for each pair of dimensions (Ahmed & Wonka, "Screen-space blue-noise diffusion of Monte
    Carlo sampling error via hierarchical ordering of pixels", 2020). After 2^32 samples the sequence begins again.
    """

    name = "blue_noise"

    @cached_property
    def _levels(self) -> int:
        return (max(self._width, self._height) - 1).bit_length()

    def _pair(self, x: Indices, y: Indices, samples: int, pair: int) -> Floats32:
        seed = self._salt(_CURVE, pair) & _MASK32
        order = self._blue_noise.shuffled_z_order(x, y, self._levels, seed)
        first = np.asarray(order).astype(np.uint64) * np.uint64(samples)
        # Within a pixel at random, for sample number i of one pair must not say where that of another lies.
        keys = first[:, None] + np.arange(samples, dtype=np.uint64)
        chance = hash_words(keys.ravel().astype(np.uint32), self._salt(_PAIRING, pair)).reshape(
            len(first), samples
        )
        place = np.argsort(chance, axis=1, kind="stable").astype(np.uint64)
        index = (first[:, None] + place) & np.uint64(_MASK32)
        return self._scrambled(index.astype(np.uint32), pair)


class DitheredSampler(_Pairwise):
    """All pixels take the same points, each moved by a mask of blue noise; a dimension has the mask from another place.

    Georgiev & Fajardo, "Blue-noise dithered sampling", 2016.
    """

    name = "dithered"

    def __init__(self, seed: int, blue_noise: Functions, size: tuple[int, int]) -> None:
        super().__init__(seed, blue_noise, size)
        # Threads share what is made once.
        self._masks = cache(self._make_masks)

    @cached_property
    def _mask(self) -> Indices:
        keys = np.arange(MASK * MASK, dtype=np.uint32)
        u = (hash_words(keys, self._salt(_START))[0] >> np.uint32(8)) * TO_UNIT
        return np.asarray(self._blue_noise.void_and_cluster(u.reshape(MASK, MASK), SIGMA))

    def _make_masks(self, pair: int) -> Indices:
        shifts = [self._salt(_MASK_SHIFT, pair, row) for row in range(2)]
        return np.stack([np.roll(self._mask, (s % MASK, s // MASK % MASK), (0, 1)) for s in shifts])

    def _pair(self, x: Indices, y: Indices, samples: int, pair: int) -> Floats32:
        chance = hash_words(np.arange(samples, dtype=np.uint32), self._salt(_PAIRING, pair))[0]
        points = self._scrambled(np.argsort(chance, kind="stable").astype(np.uint32), pair)
        moved = self._blue_noise.dithered_points(points, self._masks(pair), x, y)
        u: Floats32 = np.minimum(moved, 1 - TO_UNIT, dtype=np.float32)
        return u


SAMPLERS = {sampler.name: sampler for sampler in (BlueNoiseSampler, DitheredSampler)}
