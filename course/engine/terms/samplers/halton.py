"""Points that are even by design, made by the course's `quasi_monte_carlo` module.

All pixels take the same points, each moved by a vector of its own, modulo 1 (a Cranley-Patterson rotation: Cranley &
Patterson, "Randomization of number theoretic methods for multiple integration", 1976). The vector is uniform, so every
moved point is, and every mean is unbiased whatever the points are. A pixel's numbers depend on the seed and the pixel
alone, and not on the block that it is in.
"""

from abc import abstractmethod
from typing import Any

import numpy as np

from course.engine.core.samplers import Block, Sampler, generator
from course.engine.core.types import Floats32, Functions
from course.engine.terms.samplers.hashing import combine, hash_words

ORDERS = 256
"""Permutations of a chained pattern; two pixels share one by chance of 1 in this many."""

_KEPT_NUMBERS = 1 << 16
"""Numbers of one chained pattern in all its orders; long patterns get fewer orders."""

_KEPT_STRETCHES = 32
"""Passes of Halton's points that are kept, for threads may be at different passes."""

_FEWEST_DIMENSIONS = 16

_ROTATION, _ORDER = 1, 2
"""Salts: what a hash of pixel and dimension decides."""


class _Rotated(Sampler):
    """Dimension d of a path is coordinate d of one stretch of points, the same for all pixels."""

    def __init__(self, seed: int, quasi_monte_carlo: Functions) -> None:
        self._seed = seed
        self._quasi_monte_carlo = quasi_monte_carlo
        self._tables: dict[tuple[int, ...], Floats32] = {}

    def draw(self, block: Block, dimension: int, width: int) -> Floats32:
        """See Sampler.draw."""
        points = self._known(block, dimension + width)[dimension : dimension + width]
        return _rotated(points[:, None], self._seed, dimension, block)

    def _known(self, block: Block, dims: int) -> Floats32:
        """At least ``dims`` coordinates of a block's points, kept, since every effect asks for the next few."""
        stretch = block.first, block.samples
        known = self._tables.get(stretch)
        if known is None or len(known) < dims:
            dims = max(_FEWEST_DIMENSIONS, 1 << (dims - 1).bit_length())
            known = _modulo(self._points(block, dims))
            if len(self._tables) >= _KEPT_STRETCHES:
                self._tables.clear()
            self._tables[stretch] = known
        return known

    @abstractmethod
    def _points(self, block: Block, dims: int) -> Any:
        """The points (dims, samples) of a block."""


class HaltonSampler(_Rotated):
    """Halton's points; sample number i takes point i."""

    name = "halton"
    extensible = True

    def _points(self, block: Block, dims: int) -> Any:
        index = np.arange(block.first, block.first + block.samples)
        return self._quasi_monte_carlo.halton(index, dims)


class HammersleySampler(_Rotated):
    """Hammersley's points, of which there are as many as samples; a block has all samples of its pixels."""

    name = "hammersley"
    extensible = False

    def _points(self, block: Block, dims: int) -> Any:
        return self._quasi_monte_carlo.hammersley(block.samples, dims)


class ChainedSampler(Sampler):
    """Each effect has Hammersley's points for a pattern, in the few dimensions that it needs, in orders of its own.

    So the patterns are as even as in the first dimensions, however long the path, and only their pairing is random
    (Cook, Porter & Carpenter, "Distributed ray tracing", 1984).
    """

    name = "chained"
    extensible = False

    def __init__(self, seed: int, quasi_monte_carlo: Functions) -> None:
        self._seed = seed
        self._quasi_monte_carlo = quasi_monte_carlo
        self._tables: dict[tuple[int, int, int], Floats32] = {}

    def draw(self, block: Block, dimension: int, width: int) -> Floats32:
        """See Sampler.draw; block.samples are all samples of the pixel."""
        table = self._orders(block.samples, dimension, width)
        order = hash_words(block.pixels, combine(self._seed, dimension, _ORDER))[0]
        points = table[:, order % np.uint32(table.shape[1])]
        return _rotated(points, self._seed, dimension, block)

    def _orders(self, samples: int, dimension: int, width: int) -> Floats32:
        """(width, orders, samples): the pattern of one effect, chained once for each order."""
        key = (samples, dimension, width)
        known = self._tables.get(key)
        if known is None:
            pattern = _modulo(self._quasi_monte_carlo.hammersley(samples, width))
            count = min(ORDERS, max(_KEPT_NUMBERS // samples, 16))
            rng = generator(self._seed, dimension, Block(np.empty(0, np.uint32), 0, samples, 0))
            chained = self._quasi_monte_carlo.chain([pattern] * count, np.arange(samples), rng)
            known = np.stack([_modulo(order) for order in chained], axis=1)
            self._tables[key] = known
        return known


def _modulo(points: Floats32) -> Floats32:
    """Points from a student's function, modulo 1 as all that is rotated."""
    return np.mod(points, 1, dtype=np.float32)


def _rotated(points: Floats32, seed: int, dimension: int, block: Block) -> Floats32:
    """Move points (width, n or 1, samples) by a vector for each pixel: (width, block.size) in [0, 1)."""
    width = len(points)
    salts = [combine(seed, dimension + row, _ROTATION) for row in range(width)]
    # 24 bits, so that no number and no sum of two is rounded up to a whole one.
    shift = (hash_words(block.pixels, *salts) >> np.uint32(8)) * np.float32(2**-24)
    u: Floats32 = np.add(points, shift.astype(np.float32)[:, :, None])
    u -= u >= 1
    return u.reshape(width, block.size)
