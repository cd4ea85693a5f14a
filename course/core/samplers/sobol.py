"""The engine's default: for each pair of dimensions of a path a shuffled and scrambled (0, 2)-sequence.

The first two pairs, the pixel's and whatever a path decides next, are one net in four dimensions.

The first n points are the same whether n or 2n are asked for, so that a picture can be continued.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from course.core.hashing import combine, hash_words
from course.core.samplers.block import Block
from course.core.sobol import joined, owen_scrambled, shuffled, sobol_words
from course.core.types import Floats32, Indices, Words

TO_UNIT = np.float32(2.0**-24)

ORDERS = 1024
"""Orders and scrambles of the points; two pairs of a pixel share one by chance of 1 in this many."""

_JOINED_PAIRS = 2
"""The first pairs of dimensions, which share their order."""


class SobolSampler:
    """u = a point of the shuffled and scrambled sequence that a hash of (seed, pair, pixel) chooses.

    The sequences are tables, the same for all pixels. The exclusive-or with another hash, which keeps a
    (0, 2)-sequence one, makes each pixel's points its own (Kollig & Keller, "Efficient multidimensional sampling",
    2002): as even as if every pixel had been scrambled by itself, at a tenth of the cost.
    """

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
        pairs = _pairs(dimension, width)
        table = _points(block.first, block.samples)
        salts = _salts(self._seed, pairs)
        hashes = hash_words(block.pixels, *salts).reshape(len(pairs), 3, len(block.pixels))
        mixed = np.empty((2 * len(pairs), len(block.pixels), block.samples), np.uint32)
        for number, (order, *scramble) in enumerate(hashes):
            order %= table.shape[1]
            first_row = 2 * pairs[number] if pairs[number] < _JOINED_PAIRS else 0
            for row in range(2):
                words = mixed[2 * number + row]
                table[first_row + row].take(order, axis=0, out=words, mode="clip")
                words ^= scramble[row][:, None]
        first = dimension % 2
        chosen = mixed[first : first + width]
        chosen >>= np.uint32(8)
        u: Floats32 = np.multiply(chosen, TO_UNIT, dtype=np.float32)
        return u.reshape(width, block.size)

    def draw_some(self, block: Block, dimension: int, width: int, path: Indices) -> Floats32:
        """The columns of ``draw`` that belong to some paths (n,), made without the others where that is less work."""
        first, pair = dimension % 2, dimension // 2
        if 2 * len(path) > block.size or first + width > 2:
            return self.draw(block, dimension, width).take(path, axis=1)
        rows, salts = self.pair(block, pair)
        pixel, sample = block.places(path)
        # Hashed once for each path or for each pixel, whichever there are fewer of.
        if len(path) < len(block.pixels):
            hashes = hash_words(block.pixels.take(pixel), *salts)
        else:
            hashes = hash_words(block.pixels, *salts).take(pixel, axis=1)
        place = (hashes[0] % np.uint32(rows.shape[1])).astype(np.intp)
        place *= block.samples
        place += sample
        words = rows[first : first + width].reshape(width, -1).take(place, axis=1)
        words ^= hashes[1 + first : 1 + first + width]
        words >>= np.uint32(8)
        u: Floats32 = np.multiply(words, TO_UNIT, dtype=np.float32)
        return u

    def pair(self, block: Block, pair: int) -> tuple[Words, tuple[int, ...]]:
        """The points of a pair of dimensions, and what chooses among them.

        Returns
        -------
        points : (2 or more, orders, samples) uint32; the pair's are the first two rows
        salts : with which a pixel's number is hashed for its order and for either scramble
        """
        rows = _points(block.first, block.samples)[2 * pair if pair < _JOINED_PAIRS else 0 :]
        return rows, _salts(self._seed, range(pair, pair + 1))


def _pairs(dimension: int, width: int) -> range:
    return range(dimension // 2, (dimension + width - 1) // 2 + 1)


@lru_cache(maxsize=1024)
def _salts(seed: int, pairs: range) -> tuple[int, ...]:
    """Of each pair: one for its order and one for either scramble."""
    return tuple(
        combine(seed, 0 if word == 0 and pair < _JOINED_PAIRS else pair, word)
        for pair in pairs
        for word in range(3)
    )


@lru_cache(maxsize=64)
def _points(first: int, samples: int) -> Words:
    """(4, orders, samples) uint32: a stretch of the sequence in every order, each scrambled in its way.

    Rows 0 and 1 are any pair's, rows 2 and 3 those of the pair that is joined to the first.
    """
    index = np.arange(first, first + samples, dtype=np.uint32)
    # The renderer asks for 16 samples at a time; whoever asks for very long stretches gets fewer orders of them.
    orders = min(ORDERS, max(2**20 // samples, 1))
    order = shuffled(index, orders)
    words = np.concatenate([sobol_words(order), sobol_words(joined(order))])
    seeds = hash_words(np.arange(orders, dtype=np.uint32), *(combine(row) for row in range(1, 5)))
    return owen_scrambled(words, seeds[:, :, None])
