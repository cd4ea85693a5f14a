"""Sobol points: the laws of a (0, m, 1)-sequence in every dimension, and how pairs of dimensions spread."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.stats import qmc

from course.core import sobol
from course.core.sobol import DIMENSIONS, direction_numbers, sobol_words


def unit(dimension: int, first: int, count: int) -> NDArray[np.float64]:
    return sobol_words(dimension, first, count) / 2.0**32


@pytest.mark.parametrize("m", range(11))
def test_every_dyadic_block_of_every_dimension_is_stratified(m: int) -> None:
    n = 2**m
    for dimension in range(DIMENSIONS):
        for block in (0, 1, 2, 3, 5, 8):
            words = sobol_words(dimension, block * n, n).astype(np.uint64)
            strata = (words << np.uint64(m)) >> np.uint64(32)
            assert np.array_equal(np.sort(strata), np.arange(n)), (dimension, block)


def test_no_two_dimensions_are_equal() -> None:
    rows = {tuple(sobol_words(dimension, 0, 1024).tolist()) for dimension in range(DIMENSIONS)}
    assert len(rows) == DIMENSIONS


def test_direction_numbers_fill_the_word_from_the_left() -> None:
    for dimension in range(DIMENSIONS):
        for k, number in enumerate(direction_numbers(dimension)):
            assert 0 < number < 2**32
            # Bit 31 - k is the last one set: the numbers are odd before they are aligned.
            assert number & -number == 1 << (31 - k)


def test_with_published_initial_numbers_the_sequence_is_scipys(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    # The first rows of Joe & Kuo, "Constructing Sobol sequences with better two-dimensional projections", 2008.
    rows = ((0, ()), (3, (1,)), (7, (1, 3)), (11, (1, 3, 1)), (13, (1, 1, 1)), (19, (1, 1, 3, 3)))
    monkeypatch.setattr(sobol, "POLYNOMIALS_AND_INITIAL_NUMBERS", rows)
    monkeypatch.setattr(sobol, "direction_numbers", direction_numbers.__wrapped__)
    n = 1024
    index = np.arange(n)
    # SciPy walks the sequence in the order of the Gray code, one bit a step.
    gray = index ^ (index >> 1)
    theirs = qmc.Sobol(len(rows), scramble=False, bits=32).random(n).T
    ours = [unit(dimension, 0, n)[gray] for dimension in range(len(rows))]
    assert np.array_equal(ours, theirs)


def test_the_first_two_dimensions_are_those_of_every_sobol_sequence() -> None:
    assert unit(0, 0, 8).tolist() == [0, 0.5, 0.25, 0.75, 0.125, 0.625, 0.375, 0.875]
    assert unit(1, 0, 8).tolist() == [0, 0.5, 0.75, 0.25, 0.625, 0.125, 0.375, 0.875]


def test_a_stretch_is_part_of_the_whole() -> None:
    for dimension in (0, 1, 2, 17, DIMENSIONS - 1):
        whole = sobol_words(dimension, 0, 300)
        pieces = [sobol_words(dimension, *piece) for piece in ((0, 7), (7, 100), (107, 193))]
        assert np.array_equal(np.concatenate(pieces), whole)
    assert sobol_words(3, 5, 0).shape == (0,)


def test_far_along_the_sequence_points_stay_stratified() -> None:
    first = 2**32 - 256
    strata = sobol_words(7, first, 256) >> np.uint32(24)
    assert np.array_equal(np.sort(strata), np.arange(256))


@pytest.mark.parametrize("n", [16, 64, 256])
def test_the_pairs_that_are_drawn_together_are_far_more_even_than_random_points(n: int) -> None:
    # Warps take dimensions (2j, 2j + 1). The L2-star discrepancy of n random points has a mean square of
    # (1/4 - 1/9) / n, and even a bad Sobol pair must beat it at these n.
    random = np.sqrt((1 / 4 - 1 / 9) / n)
    found = []
    for dimension in range(0, DIMENSIONS, 2):
        pair = np.stack((unit(dimension, 0, n), unit(dimension + 1, 0, n)), axis=1)
        found.append(qmc.discrepancy(pair, method="L2-star"))
    assert max(found) < random
    assert np.mean(found) < {16: 0.7, 64: 0.4, 256: 0.22}[n] * random


def test_pairs_cover_elementary_squares() -> None:
    # In 4^4 points, a 4 x 4 grid has 16 in each cell for any pair; a wrong recurrence shows as empty cells.
    for dimension in range(0, DIMENSIONS, 2):
        x = sobol_words(dimension, 0, 256) >> np.uint32(30)
        y = sobol_words(dimension + 1, 0, 256) >> np.uint32(30)
        assert np.bincount(4 * y + x, minlength=16).min() == 16, dimension
