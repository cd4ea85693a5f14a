"""What tests of student-facing functions share: where the functions are, and how they are judged.

test_conventions.py holds the solutions to all laws that are declared in course/school/grading/modules, and to more than
students are asked for: double precision, the worst numbers there are, and messages. The files beside it compare
functions with truths of another origin than the laws', and try what no law asks.

Every statistical test draws from a fixed seed, so it never fails by chance twice; FALSE_FAIL is how probable it was
that a right function fails it with a seed that nobody has tried.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from itertools import product
from math import prod

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import chdtri, ndtri

from course.engine.functions.effects import PROJECT, Effects
from course.school.grading.checks import drawing
from course.school.grading.checks.vectors import UNIT, unit_vectors

SOLUTIONS = Effects(PROJECT / "solutions")

FALSE_FAIL = 1e-6
"""Of each statistical comparison."""

Array = NDArray[np.floating]


@contextmanager
def named(case: str) -> Iterator[None]:
    """One of many small cases of a test: thousands of tests would take longer to collect than to run."""
    try:
        yield
    except BaseException as error:
        error.add_note(f"in {case}")
        raise


def unit(rows: int, n: int, dtype: type = np.float32, seed: int = 0) -> Array:
    """Uniform (rows, n) numbers in [0, 1)."""
    return np.random.default_rng(seed).random((rows, n), dtype)


def worst_units(rows: int, dtype: type) -> Array:
    """Every combination of the ends of [0, 1), of their neighbours and of the middle, a column each.

    1 is among them, for a number next to it may be rounded to it.
    """
    dtype = np.dtype(dtype).type
    last = np.nextafter(dtype(1), dtype(0))
    sampler_last = 1 - 2.0**-24
    ends = [0.0, np.finfo(dtype).smallest_subnormal, 0.5, sampler_last, last, 1.0]
    return np.array([*product(ends, repeat=rows)], dtype).T


def frozen(array: ArrayLike) -> Array:
    """A copy that can't be written to."""
    copy = np.array(array)
    copy.flags.writeable = False
    return copy


def directions(n: int, dtype: type, seed: int) -> Array:
    """Unit vectors, uniform on the sphere; the same for each dtype, but for rounding."""
    return unit_vectors(np.random.default_rng(seed), n, dtype)


def worst_directions(dtype: type) -> Array:
    """Those of the checks, and the axes with the smallest numbers that there are beside them."""
    small = np.finfo(dtype).smallest_subnormal
    beside = [
        np.roll((a, b, end), k)
        for a, b in product((0.0, small, -small), repeat=2)
        for end in (1.0, -1.0)
        for k in range(3)
    ]
    return np.concatenate((drawing.worst_directions(dtype), np.array(beside, dtype).T), axis=1)


def every_pair(a: Array, b: Array) -> tuple[Array, Array]:
    """Each column of a with each column of b."""
    return np.repeat(a, b.shape[1], axis=1), np.tile(b, a.shape[1])


def assert_unit(directions: Array, tolerance: float = UNIT) -> None:
    """Unit length, as the contract says; which finite numbers only can be."""
    assert (np.abs(np.linalg.norm(directions.astype(float), axis=0) - 1) <= tolerance).all()


def assert_uniform(values: Array, cells: tuple[int, ...]) -> None:
    """Points (d, N) fill the unit cube evenly: Pearson's chi-squared test over a grid of cells."""
    d, n = values.shape
    assert len(cells) == d
    assert values.min() >= 0
    assert values.max() <= 1
    expected = n / prod(cells)
    assert expected >= 20, "too few points for the chi-squared distribution"
    index = np.minimum((values.T * cells).astype(int), np.array(cells) - 1)
    counts = np.bincount(np.ravel_multi_index(tuple(index.T), cells), minlength=prod(cells))
    statistic = ((counts - expected) ** 2).sum() / expected
    assert statistic < chdtri(prod(cells) - 1, FALSE_FAIL), statistic


def assert_mean(values: Array, mean: float, variance: float) -> None:
    """N independent values have that mean: a two-sided z-test with their known variance."""
    off = (values.astype(float).mean() - mean) / np.sqrt(variance / values.size)
    assert abs(off) < -ndtri(FALSE_FAIL / 2), off
