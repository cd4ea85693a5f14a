"""The default sampler: a shuffled and scrambled (0, 2)-sequence for each pair of dimensions of a path.

The first two pairs of a path, of which the pixel's is the first, form one net in four dimensions. The first n points
don't depend on the number of samples, so a picture can be continued.
"""

from functools import lru_cache
from threading import Lock

import numpy as np
from numpy.typing import NDArray

from course.engine.core.samplers import Block, Sampler
from course.engine.core.types import Floats32, Indices, Words
from course.engine.terms.samplers.hashing import combine, hash_words

TO_UNIT = np.float32(2.0**-24)

ORDERS = 1024
"""Number of orders of the points, each with a scramble. Two pairs of a pixel share one with probability 1 / ORDERS."""

KEPT = 1024
"""As many points are kept at most, in every order: 16 MB."""

FEW = ORDERS // 8
"""Of up to so many pixels times pairs of dimensions, points that aren't kept yet are made for their orders alone."""

_LINE = 16
"""Words in a line of the processor's cache."""

_NET_PAIRS = 2
"""Number of first pairs of dimensions, which share one order."""


class SobolSampler(Sampler):
    """A hash of (seed, pair, pixel) chooses one of the shuffled and scrambled sequences, whose points are the numbers.

    All pixels share the tables of sequences. The exclusive-or with another hash gives each pixel its own points, which
    are still a (0, 2)-sequence (Kollig & Keller, "Efficient multidimensional sampling", 2002). They are as even as with
    a scramble per pixel, at a tenth of the cost.
    """

    name = "sobol"
    extensible = True

    def __init__(self, seed: int) -> None:
        self._seed = seed

    def draw(self, block: Block, dimension: int, width: int) -> Floats32:
        """See ``Sampler.draw``; 24 bits, so that no number rounds up to 1."""
        pairs = _pairs(dimension, width)
        table = _points(block.first, block.samples)
        salts = _salts(self._seed, pairs)
        hashes = hash_words(block.pixels, *salts).reshape(len(pairs), 3, len(block.pixels))
        mixed = np.empty((2 * len(pairs), len(block.pixels), block.samples), np.uint32)
        for number, (order, *scramble) in enumerate(hashes):
            order %= table.shape[1]
            first_row = 2 * pairs[number] if pairs[number] < _NET_PAIRS else 0
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
        """The columns of ``draw`` for paths (m,), without computing the others if that is less work."""
        first, pair = dimension % 2, dimension // 2
        if 2 * len(path) > block.size or first + width > 2:
            return self.draw(block, dimension, width).take(path, axis=1)
        rows, salts = self.pair(block, pair)
        pixel, sample = _places(block, path)
        # One hash per path or per pixel: the smaller number.
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
        """The points of a pair of dimensions, and the salts that choose among them.

        Returns
        -------
        points : (2 or more, orders, samples) uint32; the first two rows are the pair's
        salts : hash a pixel's number into its order and its two scrambles
        """
        rows = _points(block.first, block.samples)[2 * pair if pair < _NET_PAIRS else 0 :]
        return rows, _salts(self._seed, range(pair, pair + 1))

    def tables(self, block: Block, pairs: int) -> tuple[Words, int, NDArray[np.uint64]]:
        """What the numbers of a block's first pairs of dimensions are made of.

        Returns
        -------
        points : (4, orders, n) uint32, n >= samples; orders that none of the pixels has may be undefined
        first : the place of the block's first point among them
        salts : (pairs, 3)
        """
        known = _salts(self._seed, range(pairs))
        salts = np.array(known, np.uint64).reshape(pairs, 3)
        first, samples = block.first, block.samples
        end = first + samples
        few = len(block.pixels) * pairs <= FEW and samples <= KEPT
        if few and not _FIRST.has(end):
            order = np.unique(hash_words(block.pixels, *known[::3]) % np.uint32(ORDERS))
            points = np.empty((4, ORDERS, samples), np.uint32)
            points[:, order] = _made(first, samples, order)
            return points, 0, salts
        if end > KEPT:
            return _points(first, samples), 0, salts
        return _FIRST.points(end), first, salts


def _places(block: Block, path: Indices) -> tuple[Indices, Indices]:
    """Indices into ``block.pixels`` and sample numbers, counted from ``block.first``, (m,) each, of paths (m,)."""
    bits = block.samples.bit_length() - 1
    if block.samples == 1 << bits:
        return path >> bits, path & (block.samples - 1)
    pixel, sample = np.divmod(path, block.samples)
    return pixel, sample


def _pairs(dimension: int, width: int) -> range:
    return range(dimension // 2, (dimension + width - 1) // 2 + 1)


@lru_cache(maxsize=1024)
def _salts(seed: int, pairs: range) -> tuple[int, ...]:
    """Three salts per pair: for the order and the two scrambles."""
    return tuple(
        combine(seed, 0 if word == 0 and pair < _NET_PAIRS else pair, word)
        for pair in pairs
        for word in range(3)
    )


def _made(first: int, samples: int, order: Words) -> Words:
    """(4, k, samples) uint32: a range of the sequence in some orders (k,); each order has its own scramble.

    Rows 2 and 3 are the second pair's, rows 0 and 1 every other pair's.
    """
    index = shuffled(np.arange(first, first + samples, dtype=np.uint32), order)
    words = np.concatenate([sobol_words(index), sobol_words(net_indices(index))])
    seeds = hash_words(order, *(combine(row) for row in range(1, 5)))
    return owen_scrambled(words, seeds[:, :, None])


class _FirstPoints:
    """The first points of the sequence in every order, as many as have been asked for.

    Adaptive sampling asks for many ranges that overlap. To make each of them took a quarter of its time.
    """

    def __init__(self) -> None:
        self._points = np.empty((4, ORDERS, 0), np.uint32)
        self._lock = Lock()

    def has(self, end: int) -> bool:
        """Whether so many points are made."""
        return self._points.shape[2] >= end

    def points(self, end: int) -> Words:
        """(4, ORDERS, n) with n >= end; end is at most KEPT."""
        with self._lock:
            known = self._points.shape[2]
            if known < end:
                # An odd number of lines, so that the orders' rows don't begin in a few sets of the cache.
                lines = -(-max(end, known + known // 2) // _LINE) | 1
                more = _made(known, lines * _LINE - known, _every(ORDERS))
                self._points = np.concatenate((self._points, more), axis=2)
            return self._points


_FIRST = _FirstPoints()


def _every(orders: int) -> Words:
    return np.arange(orders, dtype=np.uint32)


@lru_cache(maxsize=16)
def _points(first: int, samples: int) -> Words:
    """(4, orders, samples) uint32: a range of the sequence in every order."""
    if (end := first + samples) <= KEPT:
        return np.ascontiguousarray(_FIRST.points(end)[:, :, first:end])
    # The renderer uses 16 samples per call; fewer orders bound the memory of long ranges.
    return _made(first, samples, _every(min(ORDERS, max(2**20 // samples, 1))))


BITS = 32


def _second_dimension() -> list[int]:
    """Direction numbers of x + 1, left-aligned: m_k = 2 m_(k-1) xor m_(k-1) (Bratley & Fox 1988)."""
    numbers = [1]
    while len(numbers) < BITS:
        numbers.append((numbers[-1] << 1) ^ numbers[-1])
    return [number << (BITS - 1 - k) for k, number in enumerate(numbers)]


DIRECTIONS = ([1 << (BITS - 1 - k) for k in range(BITS)], _second_dimension())
"""Direction numbers v_k of both dimensions: a point is the exclusive-or of the v_k at the set bits k of its index."""


def sobol_words(index: Words) -> Words:
    """Points (2, ...) uint32 of the sequence, as 32-bit fractions, at indices of any shape."""
    words = np.zeros((2, *index.shape), np.uint32)
    for k in range(int(index.max(initial=0)).bit_length()):
        bit = (index >> np.uint32(k)) & np.uint32(1)
        for dimension in range(2):
            words[dimension] ^= bit * np.uint32(DIRECTIONS[dimension][k])
    return words


_NET_COLUMNS = (1, 2, 5, 11, 16, 33, 67, 236, 303, 565, 1744, 2769, 5363, 11408)
"""Column k is the image of 2^k under ``net_indices``; its highest bit is k. Found by a beam search. The cost was the
sum of t^2 (see ``net_indices``) over m = 1 to 14 and over all nets in two, three and four of the four dimensions."""


def net_indices(index: Words) -> Words:
    """Indices of the points for dimensions 3 and 4: with the points at ``index``, they form a net in four dimensions.

    The map is linear over bits and triangular, so it permutes every aligned block of 2^m indices. So the points at the
    new indices are a (0, 2)-sequence, too. Among the first 2^m points, every dyadic box of volume 2^(t - m) in the four
    dimensions has 2^t points, with t = 1 for m = 4 and 6, and at most 3 for m up to 10.
    """
    words = index.copy()
    for k, column in enumerate(_NET_COLUMNS):
        words ^= ((index >> np.uint32(k)) & np.uint32(1)) * np.uint32(column ^ 1 << k)
    return words


def shuffled(index: Words, order: Words) -> Words:
    """Nested random permutations of indices (n,), (k, n) uint32, one for each of k numbers.

    Bit j of an index is flipped at random, alike for all indices that agree in the bits above it. If all bits above are
    0, bit j is not flipped. So indices below 2^m stay below 2^m, for every m.
    """
    result = np.repeat(index[None], len(order), axis=0)
    for bit in range(int(index.max(initial=0)).bit_length()):
        higher_bits = index >> np.uint32(bit + 1)
        keys = hash_words(order, combine(bit))[0][:, None] ^ higher_bits
        chance = hash_words(keys.ravel(), combine(bit, 1)).reshape(keys.shape)
        result ^= (chance & np.uint32(1)) * (higher_bits > 0) << np.uint32(bit)
    return result


def owen_scrambled(words: Words, seeds: Words) -> Words:
    """Nested uniform scramble: each digit is flipped at random, alike for words with equal digits before it.

    The hash of Laine & Karras (2011), with Vegdahl's constants (2021). It reverses the words, as Burley (2020) does, so
    that additions and multiplications carry only from earlier digits to later ones.

    Parameters
    ----------
    words : (..., n) uint32
    seeds : uint32 that broadcasts against words; one scramble each
    """
    state = reversed_bits(words) + np.zeros_like(seeds)
    state ^= state * np.uint32(0x3D20ADEA)
    state += seeds
    state *= (seeds >> np.uint32(16)) | np.uint32(1)
    state ^= state * np.uint32(0x05526C56)
    state ^= state * np.uint32(0x53A22864)
    return reversed_bits(state)


def reversed_bits(words: Words) -> Words:
    """Words with their 32 bits in reverse order."""
    for shift, mask in ((1, 0x55555555), (2, 0x33333333), (4, 0x0F0F0F0F), (8, 0x00FF00FF)):
        low = np.uint32(mask)
        words = ((words >> np.uint32(shift)) & low) | ((words & low) << np.uint32(shift))
    return (words >> np.uint32(16)) | (words << np.uint32(16))
