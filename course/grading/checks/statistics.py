"""Tests of distributions whose probability to fail a right function is stated, FALSE_FAIL each.

Students' points may be stratified, since the numbers that they warp may be Sobol's; all tests here are for
independent numbers, so the checks draw theirs from ``Trial.rng``.
"""

from __future__ import annotations

from math import sqrt

import numpy as np
from scipy.special import chdtri, ndtri

from course.grading.checks.check import Array, Failure

FALSE_FAIL = 1e-7
"""Of each comparison: a hundred in an assignment stay under 1e-5."""

SIGMAS = -float(ndtri(FALSE_FAIL / 2))
"""Standard errors that a mean or a share must be off to fail."""


def check_uniform(values: Array, cells: tuple[int, ...], what: str, hint: str = "") -> None:
    """(d, N) values fill the unit cube evenly: Pearson's chi-squared test over a grid of cells.

    Raises
    ------
    Failure
    """
    counts = counted(values, cells)
    expected = values.shape[1] / counts.size
    chi_squared(counts.ravel(), np.full(counts.size, expected), what, hint)


def counted(values: Array, cells: tuple[int, ...]) -> Array:
    """How many of (d, N) values in the unit cube lie in each cell of a grid."""
    index = np.clip((values.T * cells).astype(np.int64), 0, np.array(cells) - 1)
    return np.bincount(
        np.ravel_multi_index(tuple(index.T), cells), minlength=int(np.prod(cells))
    ).reshape(cells)


def chi_squared(counts: Array, expected: Array, what: str, hint: str = "") -> None:
    """Counts are as probable as that.

    Raises
    ------
    Failure
    """
    statistic = float(((counts - expected) ** 2 / expected).sum())
    limit = float(chdtri(counts.size - 1, FALSE_FAIL))
    if not statistic < limit:
        worst = int(np.argmax(np.abs(counts - expected) / np.sqrt(expected)))
        raise Failure(
            f"{what}: chi-squared under {limit:.0f} over {counts.size} cells",
            f"{statistic:.0f}",
            f"cell {worst} holds {counts.flat[worst]:.0f} points, {expected.flat[worst]:.0f} were to be expected",
            hint,
        )


def check_mean(values: Array, mean: float, variance: float, what: str, hint: str = "") -> None:
    """Independent values have that mean: a two-sided z-test with their known variance.

    Raises
    ------
    Failure
    """
    found = float(values.astype(np.float64).mean())
    bound = SIGMAS * sqrt(variance / values.size)
    if not abs(found - mean) <= bound:
        raise Failure(f"{what}: {mean:.6g} within {bound:.2g}", f"{found:.6g}", "", hint)
