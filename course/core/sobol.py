"""The (0, 2)-sequence: Sobol's first two dimensions, and orders to take its points in.

The first dimension is the radical inverse in base 2, the second belongs to the polynomial x + 1 (Sobol 1967). Each
stretch of 2^m points that begins at a multiple of 2^m has exactly one point in every dyadic rectangle of area 2^-m.

A path needs more than two numbers. Sobol's higher dimensions would be there, but at the sample counts of a renderer
many pairs of them are locked together (squared correlations of 0.6 within a pixel at 16 and at 64 samples). So each
pair of dimensions takes the same points in a shuffled order of its own (Burley, "Practical hash-based Owen
scrambling", 2020): a nested permutation, which keeps blocks of 2^m blocks, keeps every pair's stratification and
leaves nothing between pairs but chance. The first two pairs, which every path draws, do better: they share an order,
and the second takes the points at ``joined`` indices, so that the four together are stratified too. Their values are
scrambled in the same way (Owen 1995): left as they are, the points' symmetries meet those of a scene, and the error
can exceed that of jittered points.
"""

from __future__ import annotations

import numpy as np

from course.core.hashing import combine, hash_words
from course.core.types import Words

BITS = 32


def _second_dimension() -> list[int]:
    """Direction numbers of x + 1, left-aligned: m_k = 2 m_(k-1) xor m_(k-1) (Bratley & Fox 1988)."""
    numbers = [1]
    while len(numbers) < BITS:
        numbers.append((numbers[-1] << 1) ^ numbers[-1])
    return [number << (BITS - 1 - k) for k, number in enumerate(numbers)]


DIRECTIONS = ([1 << (BITS - 1 - k) for k in range(BITS)], _second_dimension())
"""For both dimensions the direction numbers v_k: a point is the exclusive-or of those at the set bits of its index."""


def sobol_words(index: Words) -> Words:
    """Points of the sequence as 32-bit fractions.

    Parameters
    ----------
    index : uint32 of any shape

    Returns
    -------
    (2, ...) uint32
    """
    words = np.zeros((2, *index.shape), np.uint32)
    for k in range(int(index.max(initial=0)).bit_length()):
        bit = (index >> np.uint32(k)) & np.uint32(1)
        for dimension in range(2):
            words[dimension] ^= bit * np.uint32(DIRECTIONS[dimension][k])
    return words


_JOINED_COLUMNS = (1, 2, 5, 11, 16, 33, 67, 236, 303, 565, 1744, 2769, 5363, 11408)
"""Images of the powers of two under ``joined``, found by a beam search: column k has bit k and no higher one, and the
cost was the sum over m = 1 to 14 of the squared t of all nets in two, three and four of the four dimensions."""


def joined(index: Words) -> Words:
    """Indices whose points, taken as dimensions 3 and 4 beside those at ``index``, make a net in four dimensions.

    The map is linear over bits and triangular: a permutation of every block of 2^m that begins at a multiple of 2^m,
    so that the points at the new indices are a (0, 2)-sequence as those at the old ones are. Among the first 2^m
    points every dyadic box of volume 2^(t - m) in the four dimensions has its 2^t points, with t = 1 for m = 4 and 6,
    and at most 3 for m up to 10.
    """
    words = index.copy()
    for k, column in enumerate(_JOINED_COLUMNS):
        words ^= ((index >> np.uint32(k)) & np.uint32(1)) * np.uint32(column ^ 1 << k)
    return words


def shuffled(index: Words, orders: int) -> Words:
    """Indices in some shuffled orders, each a nested permutation.

    Bit j of an index is flipped by chance, the same chance for all indices that agree in the bits above it; where
    those are all 0 it stays. So indices below 2^m stay below 2^m, for every m.

    Parameters
    ----------
    index : (n,) uint32
    orders : how many

    Returns
    -------
    (orders, n) uint32
    """
    order = np.arange(orders, dtype=np.uint32)
    result = np.repeat(index[None], orders, axis=0)
    for bit in range(int(index.max(initial=0)).bit_length()):
        above = index >> np.uint32(bit + 1)
        keys = hash_words(order, combine(bit))[0][:, None] ^ above
        chance = hash_words(keys.ravel(), combine(bit, 1)).reshape(keys.shape)
        result ^= (chance & np.uint32(1)) * (above > 0) << np.uint32(bit)
    return result


def owen_scrambled(words: Words, seeds: Words) -> Words:
    """Words after a nested uniform scramble: each digit is flipped by chance, the same for equal digits before it.

    Parameters
    ----------
    words : (..., n) uint32
    seeds : uint32 that broadcasts against words, one scramble each

    Returns
    -------
    uint32 of the broadcast shape

    Notes
    -----
    In a word whose bits are reversed, additions and multiplications only carry upwards, from the digits before to the
    digits after: the hash of Laine & Karras (2011), with Burley's constants (2020).
    """
    state = reversed_bits(words) + np.zeros_like(seeds)
    state ^= state * np.uint32(0x3D20ADEA)
    state += seeds
    state *= (seeds >> np.uint32(16)) | np.uint32(1)
    state ^= state * np.uint32(0x05526C56)
    state ^= state * np.uint32(0x53A22864)
    return reversed_bits(state)


def reversed_bits(words: Words) -> Words:
    """Words with bit 0 in the place of bit 31, and so on."""
    for shift, mask in ((1, 0x55555555), (2, 0x33333333), (4, 0x0F0F0F0F), (8, 0x00FF00FF)):
        low = np.uint32(mask)
        words = ((words >> np.uint32(shift)) & low) | ((words & low) << np.uint32(shift))
    return (words >> np.uint32(16)) | (words << np.uint32(16))
