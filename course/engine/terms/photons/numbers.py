"""Random numbers of photons: each pass has its own, and in a pass they are spread evenly."""

from functools import cache

import numpy as np

from course.engine.core.rays import Draws
from course.engine.core.samplers import Block, Sampler
from course.engine.core.types import Floats32, Indices, Words
from course.engine.terms.samplers.sobol import BITS, DIRECTIONS, TO_UNIT, owen_scrambled

PHOTONS = 0x70686F74
"""Keeps the generators of photons apart from those of paths with the same seed."""


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
    """Numbers (width, n) of photons from ``first`` on: Sobol's sequence, scrambled anew for each pass.

    The net is even in all dimensions together. A lattice is, too, but where few of its directions count, such as a
    photon's time and its way, its rows show as stripes.
    """
    rng = np.random.default_rng((PHOTONS, seed, number))
    seeds = rng.integers(0, 2**32, (width, 1), np.uint32)
    words = owen_scrambled(sobol_points(first, n, width), seeds)
    u: Floats32 = ((words >> np.uint32(8)) * TO_UNIT).astype(np.float32)
    return u


def sobol_points(first: int, n: int, width: int) -> Words:
    """Points (width, n) uint32 of the sequence from ``first`` on, as 32-bit fractions; up to 7 dimensions."""
    parts = []
    while n > 0:
        # A point is the exclusive-or of those at the high and at the low bits of its index.
        low = first % _TABLE
        part = _first_words()[:width, low : low + n]
        parts.append(part ^ _word(first - low)[:width, None])
        n, first = n - part.shape[1], first + part.shape[1]
    return np.concatenate(parts, axis=1) if parts else np.zeros((width, 0), np.uint32)


_TABLE = 1 << 16


@cache
def _first_words() -> Words:
    """The first points, (7, _TABLE)."""
    words = np.zeros((len(_DIRECTIONS), 1), np.uint32)
    for k in range(_TABLE.bit_length() - 1):
        words = np.concatenate((words, words ^ _DIRECTIONS[:, k, None]), axis=1)
    return words


def _word(index: int) -> Words:
    """One point, (7,)."""
    bits = [k for k in range(index.bit_length()) if index >> k & 1]
    word: Words = np.bitwise_xor.reduce(_DIRECTIONS[:, bits], axis=1)
    return word


def _directions(polynomial: int, first: tuple[int, ...]) -> list[int]:
    """Direction numbers of a dimension, left-aligned: by the recurrence of a primitive polynomial over GF(2)."""
    degree = len(first)
    numbers = list(first)
    for k in range(degree, BITS):
        m = numbers[k - degree] << degree ^ numbers[k - degree]
        for i in range(1, degree):
            m ^= (polynomial >> (degree - i) & 1) * numbers[k - i] << i
        numbers.append(m)
    return [m << (BITS - 1 - k) for k, m in enumerate(numbers)]


_DIRECTIONS = np.array(
    [
        *DIRECTIONS,
        *(
            _directions(polynomial, first)
            for polynomial, first in (
                (0b111, (1, 3)),
                (0b1011, (1, 3, 1)),
                (0b1101, (1, 1, 1)),
                (0b10011, (1, 1, 3, 3)),
                (0b11001, (1, 3, 5, 13)),
            )
        ),
    ],
    np.uint32,
)
"""Of 7 dimensions. S. Joe, F. Kuo, "Constructing Sobol sequences with better two-dimensional projections", 2008."""
