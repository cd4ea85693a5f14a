"""The warm-up: uniform points by rejection and by polar warps, and Marsaglia's generator."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from scipy.special import ndtri

from course.grading.checks.laws import DTYPES
from tests.solutions.contract import (
    FALSE_FAIL,
    SOLUTIONS,
    Array,
    assert_mean,
    assert_uniform,
    assert_unit,
    frozen,
    global_random_state_untouched,
    unit,
    worst_units,
)

disk_by_rejection = SOLUTIONS.function("sampling", "disk_by_rejection")
disk_by_polar = SOLUTIONS.function("sampling", "disk_by_polar")
ball_by_rejection = SOLUTIONS.function("sampling", "ball_by_rejection")
ball_by_polar = SOLUTIONS.function("sampling", "ball_by_polar")
sphere_by_polar = SOLUTIONS.function("sampling", "sphere_by_polar")
xorshift32 = SOLUTIONS.function("sampling", "xorshift32")

N = 100_000

dtypes = pytest.mark.parametrize("dtype", DTYPES)
rejections = pytest.mark.parametrize(
    ("function", "rows"), [(disk_by_rejection, 2), (ball_by_rejection, 3)]
)


class Counting(np.random.Generator):
    """A generator that counts the numbers it gives."""

    drawn = 0

    def random(self, size: Any = None, dtype: Any = np.float64, out: Any = None) -> Any:
        self.drawn += math.prod(size)
        return super().random(size, dtype, out)


def turn(points: Array) -> Array:
    return np.arctan2(points[1], points[0]) / (2 * np.pi) % 1


def assert_uniform_disk(points: Array) -> None:
    r2 = (points**2).sum(axis=0)
    assert r2.max() <= 1 + 1e-6
    assert_uniform(np.stack((np.minimum(r2, 1), turn(points))), (24, 24))
    for x in points:
        assert_mean(x, 0, 1 / 4)


def assert_uniform_ball(points: Array) -> None:
    r = np.linalg.norm(points, axis=0)
    assert r.max() <= 1 + 1e-6
    height = np.clip((points[2] / r + 1) / 2, 0, 1)
    assert_uniform(np.stack((np.minimum(r**3, 1), height, turn(points))), (12, 12, 12))
    for x in points:
        assert_mean(x, 0, 1 / 5)


# ---------------------------------------------------------------- points


@dtypes
def test_polar_disk_has_constant_density(dtype: type) -> None:
    assert_uniform_disk(disk_by_polar(unit(2, N, dtype, seed=1)).astype(float))


@dtypes
def test_polar_ball_has_constant_density(dtype: type) -> None:
    assert_uniform_ball(ball_by_polar(unit(3, N, dtype, seed=2)).astype(float))


@dtypes
def test_polar_sphere_has_constant_density(dtype: type) -> None:
    points = sphere_by_polar(unit(2, N, dtype, seed=3)).astype(float)
    assert_unit(points, 1e-6)
    assert_uniform(np.stack(((points[2] + 1) / 2, turn(points))), (24, 24))


def test_rejected_points_have_constant_density() -> None:
    assert_uniform_disk(disk_by_rejection(N, np.random.default_rng(4)).astype(float))
    assert_uniform_ball(ball_by_rejection(N, np.random.default_rng(5)).astype(float))


@dtypes
def test_points_stay_in_their_shape_for_the_worst_numbers(dtype: type) -> None:
    rounding = 4 * np.finfo(dtype).eps
    two, three = worst_units(2, dtype), worst_units(3, dtype)
    assert np.linalg.norm(disk_by_polar(two), axis=0).max() <= 1 + rounding
    assert np.linalg.norm(ball_by_polar(three), axis=0).max() <= 1 + rounding
    assert_unit(sphere_by_polar(np.concatenate((two, np.ones_like(two)), axis=1)), 1e-6)


# ---------------------------------------------------------------- rejection


@rejections
@pytest.mark.parametrize("n", [0, 1, 2, 1000])
def test_rejection_gives_as_many_points_as_asked_for(function: Any, rows: int, n: int) -> None:
    for seed in range(20):
        with global_random_state_untouched():
            points = function(n, np.random.default_rng(seed))
        assert points.shape == (rows, n)
        assert points.dtype == np.float32


@pytest.mark.parametrize("function", [disk_by_rejection, ball_by_rejection])
def test_the_generator_decides_which_points_come(function: Any) -> None:
    points = [function(50, np.random.default_rng(seed)) for seed in (6, 6, 7)]
    assert (points[0] == points[1]).all()
    assert (points[0] != points[2]).any()


@rejections
def test_rejection_draws_what_its_acceptance_takes(function: Any, rows: int) -> None:
    rng = Counting(np.random.PCG64(8))
    function(N, rng)
    p = math.pi / (4 if rows == 2 else 6)
    # Rejected candidates have a negative binomial distribution.
    spread = -float(ndtri(FALSE_FAIL / 2)) * math.sqrt(N * (1 - p)) / p
    assert abs(rng.drawn / rows - N / p) <= spread + 100


@pytest.mark.parametrize("function", [disk_by_rejection, ball_by_rejection])
def test_a_negative_count_is_refused(function: Any) -> None:
    with pytest.raises(ValueError, match=r"^n must be >= 0, got -1$"):
        function(-1, np.random.default_rng(0))


# ---------------------------------------------------------------- xorshift32


def test_xorshift_gives_marsaglias_numbers() -> None:
    state = np.array([2463534242], np.uint32)
    found = []
    for _ in range(5):
        state, _ = xorshift32(state)
        found.append(int(state[0]))
    assert found == [723471715, 2497366906, 2064144800, 2008045182, 3532304609]


def test_xorshift_is_the_integers_own_in_each_stream() -> None:
    states = np.random.default_rng(9).integers(0, 1 << 32, 500, dtype=np.uint32)
    new, _ = xorshift32(frozen(states))
    for x, y in zip(states.tolist(), new.tolist(), strict=True):
        x ^= x << 13 & 0xFFFFFFFF
        x ^= x >> 17
        x ^= x << 5 & 0xFFFFFFFF
        assert x == y
    assert new.dtype == np.uint32


def test_xorshift_is_one_to_one_and_keeps_zero() -> None:
    states = np.arange(1 << 16, dtype=np.uint32)
    new, _ = xorshift32(states)
    assert new[0] == 0
    assert np.unique(new).size == states.size


def test_xorshift_numbers_are_shares_of_2_to_the_32() -> None:
    states = np.random.default_rng(10).integers(1, 1 << 32, N, dtype=np.uint32)
    new, first = xorshift32(states)
    assert first.dtype == np.float32
    assert np.abs(first - new / 2**32).max() < 2**-24
    _, second = xorshift32(new)
    assert_uniform(np.stack((first, second)), (24, 24))


def test_xorshift_never_gives_1() -> None:
    # The state before 2^32 - 1, found by undoing the three shifts.
    state = 0xFFFFFFFF
    for shift, right in ((5, False), (17, True), (13, False)):
        undone = state
        for _ in range(7):
            undone = state ^ (undone >> shift if right else undone << shift & 0xFFFFFFFF)
        state = undone
    new, random = xorshift32(np.array([state], np.uint32))
    assert new == [0xFFFFFFFF]
    assert random[0] < 1


@pytest.mark.parametrize("shape", [(), (1, 4), (4, 1)])
def test_xorshift_refuses_other_shapes(shape: tuple[int, ...]) -> None:
    with pytest.raises(ValueError, match=r"^state must have shape \(N,\), got "):
        xorshift32(np.ones(shape, np.uint32))


@pytest.mark.parametrize("dtype", [np.int32, np.uint64, np.float32, bool])
def test_xorshift_refuses_other_dtypes(dtype: type) -> None:
    with pytest.raises(ValueError, match=r"^state must be uint32, got "):
        xorshift32(np.ones(4, dtype))


def test_xorshift_of_no_streams() -> None:
    new, random = xorshift32(np.empty(0, np.uint32))
    assert (new.shape, random.shape) == ((0,), (0,))
    assert (new.dtype, random.dtype) == (np.uint32, np.float32)
