"""Sobol points as 32-bit words, any stretch of the sequence at once.

x_i is the exclusive-or of the direction numbers v_k at the set bits k of the index i (Bratley & Fox 1988, "Algorithm
659"). Two words scrambled by exclusive-or with one random word stay a Sobol sequence of the same quality, which is all
that pixels need to be decorrelated (Kollig & Keller 2002).
"""

from __future__ import annotations

from functools import cache

import numpy as np

from course.core.sobol_directions import POLYNOMIALS_AND_INITIAL_NUMBERS
from course.core.types import Words

DIMENSIONS = len(POLYNOMIALS_AND_INITIAL_NUMBERS)
BITS = 32


@cache
def direction_numbers(dimension: int) -> tuple[int, ...]:
    """The 32 direction numbers of a dimension, left-aligned: v_k belongs to bit k of the index."""
    polynomial, initial = POLYNOMIALS_AND_INITIAL_NUMBERS[dimension]
    if not initial:
        return tuple(1 << (BITS - 1 - k) for k in range(BITS))
    degree = polynomial.bit_length() - 1
    numbers = list(initial)
    for k in range(degree, BITS):
        value = numbers[k - degree] ^ (numbers[k - degree] << degree)
        for j in range(1, degree):
            if polynomial >> (degree - j) & 1:
                value ^= numbers[k - j] << j
        numbers.append(value)
    return tuple(numbers[k] << (BITS - 1 - k) for k in range(BITS))


def sobol_words(dimension: int, first: int, count: int) -> Words:
    """Points ``first .. first + count - 1`` of one dimension, as 32-bit fractions.

    Parameters
    ----------
    dimension : 0 .. DIMENSIONS - 1
    first, count : which stretch; first + count <= 2^32

    Returns
    -------
    (count,) uint32
    """
    index = np.arange(first, first + count, dtype=np.uint64)
    words = np.zeros(count, np.uint32)
    for k, number in enumerate(direction_numbers(dimension)):
        if (first + count - 1) >> k == 0:
            break
        bit = ((index >> np.uint64(k)) & np.uint64(1)).astype(np.uint32)
        words ^= bit * np.uint32(number)
    return words
