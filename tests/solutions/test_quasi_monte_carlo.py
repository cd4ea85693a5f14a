"""Low discrepancy: radical inverses, Halton's and Hammersley's points, and chained patterns."""

from __future__ import annotations

from collections import Counter
from fractions import Fraction
from itertools import permutations
from typing import Any

import numpy as np
import pytest
from scipy.special import chdtri
from scipy.stats import qmc

from tests.solutions.contract import (
    FALSE_FAIL,
    SOLUTIONS,
    Array,
    frozen,
    global_random_state_untouched,
)

radical_inverse = SOLUTIONS.function("quasi_monte_carlo", "radical_inverse")
halton = SOLUTIONS.function("quasi_monte_carlo", "halton")
hammersley = SOLUTIONS.function("quasi_monte_carlo", "hammersley")
chain = SOLUTIONS.function("quasi_monte_carlo", "chain")

PRIMES = (2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37)


def exact(base: int, i: int) -> float:
    value, weight = Fraction(0), Fraction(1, base)
    while i:
        value, weight, i = value + i % base * weight, weight / base, i // base
    return float(value)


# ---------------------------------------------------------------- radical inverses


@pytest.mark.parametrize("base", [2, 3, 10, 37, 256])
@pytest.mark.parametrize("dtype", [np.int64, np.uint32, np.int32])
def test_radical_inverse_is_the_fraction_rounded(base: int, dtype: type) -> None:
    i = np.concatenate((np.arange(300), np.random.default_rng(1).integers(0, 1 << 31, 300)))
    found = radical_inverse(base, frozen(i.astype(dtype)))
    assert found.dtype == np.float32
    assert found == pytest.approx([exact(base, int(k)) for k in i], abs=2**-25 * 1.01)


def test_radical_inverses_in_base_10_can_be_read() -> None:
    assert radical_inverse(10, np.array([0, 7, 12, 980])) == pytest.approx([0, 0.7, 0.21, 0.089])


@pytest.mark.parametrize("base", [2, 3, 7])
def test_radical_inverses_stay_below_1(base: int) -> None:
    i = np.array([base**k - 1 for k in range(1, 21)] + [2**63 - 1], np.int64)
    found = radical_inverse(base, i)
    assert (found < 1).all()
    # All but the smallest difference from 1, which single precision would round away.
    assert found.max() == np.float32(1 - 2**-24)


def test_no_indices() -> None:
    none = np.empty(0, np.int64)
    assert radical_inverse(2, none).shape == (0,)
    assert halton(none, 3).shape == (3, 0)


@pytest.mark.parametrize("wrong", [1, 0, -2, 2.5, float("nan")])
def test_a_base_out_of_range_is_refused(wrong: float) -> None:
    with pytest.raises(ValueError, match=f"^base must be an integer >= 2, got {wrong}$"):
        radical_inverse(wrong, np.arange(3))


@pytest.mark.parametrize("call", [lambda i: radical_inverse(2, i), lambda i: halton(i, 2)])
def test_wrong_indices_are_refused(call: Any) -> None:
    with pytest.raises(ValueError, match=r"^i must have shape \(N,\), got \(1, 3\)$"):
        call(np.arange(3)[None])
    with pytest.raises(ValueError, match=r"^i must be an array of integers$"):
        call(np.arange(3.0))
    with pytest.raises(ValueError, match=r"^i must be >= 0, got -1$"):
        call(np.arange(3) - 1)


# ---------------------------------------------------------------- point sets


def test_halton_is_scipys_sequence() -> None:
    expected = qmc.Halton(len(PRIMES), scramble=False).random(500).T
    points = halton(np.arange(500), len(PRIMES))
    assert points.dtype == np.float32
    assert np.abs(points - expected).max() < 1e-7


def test_halton_points_can_be_had_one_by_one() -> None:
    i = np.array([4000, 3, 77])
    assert (halton(i, 4) == halton(np.arange(4001), 4)[:, i]).all()


@pytest.mark.parametrize("n", [0, 1, 7, 1000])
@pytest.mark.parametrize("dims", [1, 2, 5])
def test_hammersley_counts_and_then_mirrors(n: int, dims: int) -> None:
    points = hammersley(n, dims)
    assert points.shape == (dims, n)
    assert points.dtype == np.float32
    assert (points[0] == (np.arange(n) / max(n, 1)).astype(np.float32)).all()
    if dims > 1:
        assert (points[1:] == halton(np.arange(n), dims - 1)).all()


@pytest.mark.parametrize("wide", range(9))
def test_hammersley_has_one_point_in_each_elementary_interval(wide: int) -> None:
    x, y = hammersley(256, 2)
    cells = (x * 2**wide).astype(int) * 2 ** (8 - wide) + (y * 2 ** (8 - wide)).astype(int)
    assert np.unique(cells).size == 256


def test_errors_fall_faster_than_those_of_random_points() -> None:
    errors = []
    for n in (100, 10_000):
        points = hammersley(n, 3).astype(float)
        errors.append(abs(float(np.prod(2 * points, axis=0).mean()) - 1))
    # Random points have an error of 1.17 / sqrt(n), and a tenth of it for a hundred times as many.
    assert errors[0] < 0.06
    assert errors[1] < errors[0] / 30


def test_dims_and_counts_out_of_range_are_refused() -> None:
    for call in (lambda: hammersley(3, 0), lambda: halton(np.arange(3), 0)):
        with pytest.raises(ValueError, match=r"^dims must be >= 1, got 0$"):
            call()
    with pytest.raises(ValueError, match=r"^n must be >= 0, got -1$"):
        hammersley(-1, 2)


# ---------------------------------------------------------------- chaining


def patterns(s: int) -> tuple[Array, ...]:
    """Lens, light, time and gloss."""
    rng = np.random.default_rng(2)
    kinds = ((2, np.float32), (2, np.float64), (1, np.float32), (3, np.float64))
    return tuple(frozen(rng.random((d, s)).astype(dtype)) for d, dtype in kinds)


def taken(samples: Array, pattern: Array) -> list[int]:
    """Which sample each column is."""
    return [int(np.flatnonzero((pattern == x[:, None]).all(axis=0))[0]) for x in samples.T]


@pytest.mark.parametrize("s", [1, 2, 16])
def test_each_pixel_takes_each_sample_of_each_pattern_once(s: int) -> None:
    given = patterns(s)
    ids = np.tile(np.arange(s), 3)
    with global_random_state_untouched():
        samples = chain(given, frozen(ids), np.random.default_rng(3))
    assert isinstance(samples, tuple)
    for found, pattern in zip(samples, given, strict=True):
        assert found.dtype == pattern.dtype
        order = taken(found, pattern)
        assert sorted(order[:s]) == list(range(s))
        assert order == order[:s] * 3


def test_the_id_alone_picks_the_sample() -> None:
    ids = np.array([5, 5, 0, 15, 5])
    whole = chain(patterns(16), np.arange(16), np.random.default_rng(4))
    some = chain(patterns(16), ids, np.random.default_rng(4))
    for a, b in zip(whole, some, strict=True):
        assert (a[:, ids] == b).all()


def assert_alike_often(seen: Counter[Any], cells: int) -> None:
    expected = seen.total() / cells
    assert expected >= 20
    counts = np.array([*seen.values(), *[0] * (cells - len(seen))])
    statistic = ((counts - expected) ** 2).sum() / expected
    assert statistic < chdtri(cells - 1, FALSE_FAIL)


def test_permutations_are_uniform_and_independent() -> None:
    pattern = np.array([[0.0, 1.0, 2.0]])
    samples = chain((pattern,) * 4000, np.arange(3), np.random.default_rng(5))
    orders = [tuple(x[0].astype(int).tolist()) for x in samples]
    assert set(orders) == set(permutations(range(3)))
    assert_alike_often(Counter(orders), 6)
    assert_alike_often(Counter(zip(orders[::2], orders[1::2], strict=True)), 36)


def test_effects_are_not_correlated() -> None:
    """Of rays that all see the same pixel, lens and light have nothing to do with each other."""
    s = 1024
    grid = hammersley(s, 2)
    lens, light = chain((grid, grid), np.arange(s), np.random.default_rng(6))
    correlation = np.corrcoef(np.concatenate((lens, light)))[:2, 2:]
    assert np.abs(correlation).max() < 5 / np.sqrt(s)


def test_no_rays_and_no_patterns() -> None:
    none = np.empty(0, np.int64)
    assert [x.shape for x in chain(patterns(4), none, np.random.default_rng(0))] == [
        (2, 0),
        (2, 0),
        (1, 0),
        (3, 0),
    ]
    assert chain((), none, np.random.default_rng(0)) == ()


def test_wrong_patterns_and_ids_are_refused() -> None:
    good, ids, rng = np.ones((2, 4)), np.arange(4), np.random.default_rng(0)
    for given, message in (
        ((good[0],), r"^patterns\[0\] must have shape \(d, s\), got \(4,\)$"),
        ((good, good[:, :3]), r"^patterns\[1\] must have shape \(d, 4\), got \(2, 3\)$"),
    ):
        with pytest.raises(ValueError, match=message):
            chain(given, ids, rng)
    for wrong, message in (
        (ids[None], r"^ids must have shape \(N,\), got \(1, 4\)$"),
        (ids + 0.0, r"^ids must be an array of integers$"),
        (ids - 1, r"^ids must be >= 0, got -1$"),
        (ids + 1, r"^ids must be < 4, got 4$"),
    ):
        with pytest.raises(ValueError, match=message):
            chain((good,), wrong, rng)
