"""Antialiasing: point patterns of a pixel, Gaussian weights, and the weighted mean."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest

from course.grading.checks.laws import DTYPES
from tests.solutions.contract import (
    SOLUTIONS,
    Array,
)

regular = SOLUTIONS.function("supersampling", "regular")
random = SOLUTIONS.function("supersampling", "random")
jittered = SOLUTIONS.function("supersampling", "jittered")
gaussian_weights = SOLUTIONS.function("supersampling", "gaussian_weights")
resolve = SOLUTIONS.function("supersampling", "resolve")

PATTERNS: dict[str, Callable[[int, int, int], Array]] = {
    "regular": lambda k, n, _seed: regular(k, n),
    "random": lambda k, n, seed: random(k, n, np.random.default_rng(seed)),
    "jittered": lambda k, n, seed: jittered(k, n, np.random.default_rng(seed)),
}

pattern = pytest.mark.parametrize("name", PATTERNS)
dtypes = pytest.mark.parametrize("dtype", DTYPES)


def cells(k: int) -> Array:
    """Column and row of each cell, (2, k * k): row by row, x fastest."""
    number = np.arange(k * k)
    return np.array([number % k, number // k])


def exact_mean(radiance: Array, weights: Array) -> Array:
    """The weighted mean in float64."""
    radiance, weights = radiance.astype(float), weights.astype(float)
    return (radiance * weights).sum(axis=2) / weights.sum(axis=1)


def batch(n: int, s: int, dtype: type = np.float32, seed: int = 0) -> tuple[Array, Array]:
    """Radiance and weights."""
    rng = np.random.default_rng(seed)
    return rng.random((3, n, s), dtype), rng.random((n, s), dtype)


# ---------------------------------------------------------------- patterns


@pattern
@pytest.mark.parametrize(("k", "n"), [(1, 1), (1, 7), (4, 5), (3, 0), (1, 0), (256, 1)])
def test_patterns_have_k_squared_float32_points_in_each_pixel(name: str, k: int, n: int) -> None:
    points = PATTERNS[name](k, n, 1)
    assert points.shape == (2, n, k * k)
    assert points.dtype == np.float32
    assert ((points >= 0) & (points <= 1)).all()


@pattern
@pytest.mark.parametrize("number", [np.int64, np.uint16])
def test_numpy_integers_are_integers(name: str, number: type) -> None:
    assert (PATTERNS[name](number(3), number(2), 1) == PATTERNS[name](3, 2, 1)).all()


@pattern
@pytest.mark.parametrize(("k", "n", "told"), [(0, 1, "k"), (-1, 1, "k"), (2, -1, "n")])
def test_patterns_refuse_counts_out_of_range(name: str, k: int, n: int, told: str) -> None:
    got = {"k": k, "n": n}[told]
    with pytest.raises(ValueError, match=rf"^{told} must be >= \d, got {got}$"):
        PATTERNS[name](k, n, 1)


@pytest.mark.parametrize("k", [1, 2, 3, 4, 7, 16, 255])
def test_regular_points_are_the_cell_centres_row_by_row_in_every_pixel(k: int) -> None:
    points = regular(k, 3)
    centres = (cells(k) + 0.5) / k
    assert np.abs(points - centres[:, None]).max() <= 2.0**-24
    assert (points < 1).all()


def test_one_regular_point_is_exactly_the_pixels_centre() -> None:
    assert (regular(1, 5) == 0.5).all()


# ---------------------------------------------------------------- Gaussian weights


@dtypes
@pytest.mark.parametrize("sigma", [0.05, 1 / 6, 0.5, 1, 20.0])
def test_gaussian_weights_are_the_gaussian_of_the_distance_to_the_centre(
    dtype: type, sigma: float
) -> None:
    offsets = np.random.default_rng(1).random((2, 40, 9), dtype)
    r2 = ((offsets.astype(float) - 0.5) ** 2).sum(axis=0)
    weights = gaussian_weights(offsets, sigma)
    assert weights.dtype == dtype
    # An exponent x carries its own rounding into the result: exp(x) has a relative error of |x| eps.
    exponent = r2 / (2 * sigma**2)
    error = np.abs(weights - np.exp(-exponent))
    tiny = np.finfo(dtype).tiny
    assert (error <= 8 * (1 + exponent) * np.finfo(dtype).eps * np.exp(-exponent) + tiny).all()


@dtypes
@pytest.mark.parametrize("sigma", [1e-6, 1e-4, 1e4, 1e6])
def test_gaussian_weights_are_right_for_the_smallest_and_the_largest_sigma(
    dtype: type, sigma: float
) -> None:
    off_centre = [0.0, 0.4, np.nextafter(dtype(0.5), dtype(0)), 1 - 2.0**-24]
    offsets = np.full((2, 1, 5), 0.5, dtype)
    offsets[0, 0, 1:] = off_centre
    weights = gaussian_weights(offsets, sigma)
    assert np.isfinite(weights).all()
    assert weights[0, 0] == 1
    assert weights[0, 1] == pytest.approx(1 if sigma > 1 else 0, abs=1e-8)
    # The neighbour of 0.5 is 2^-25 away in float32, a thirtieth of a sigma of 1e-6, and 2^-54 in float64.
    next_to = math.exp(-((2.0**-25 / sigma) ** 2) / 2) if dtype is np.float32 else 1
    assert weights[0, 3] == pytest.approx(next_to, rel=1e-6)


@dtypes
@pytest.mark.parametrize("scalar", [float, np.float32, np.float64, np.longdouble])
def test_sigma_does_not_change_the_dtype(dtype: type, scalar: type) -> None:
    offsets = np.random.default_rng(1).random((2, 4, 3), dtype)
    assert gaussian_weights(offsets, scalar(0.25)).dtype == dtype
    assert gaussian_weights(offsets, np.array(0.25)).dtype == dtype


@pytest.mark.parametrize("sigma", [0, -1.0, math.nan, -math.inf])
def test_a_sigma_out_of_range_is_refused(sigma: float) -> None:
    with pytest.raises(ValueError, match=f"^sigma must be > 0, got {sigma}$"):
        gaussian_weights(np.zeros((2, 1, 1), np.float32), sigma)


@pytest.mark.parametrize(("n", "s"), [(0, 4), (3, 0), (0, 0)])
def test_no_offsets_have_no_weights(n: int, s: int) -> None:
    weights = gaussian_weights(np.zeros((2, n, s), np.float32))
    assert weights.shape == (n, s)
    assert weights.dtype == np.float32


# ---------------------------------------------------------------- resolve


@pytest.mark.parametrize("radiance_dtype", DTYPES)
@pytest.mark.parametrize("weights_dtype", DTYPES)
def test_resolve_is_the_weighted_mean_in_the_promoted_dtype(
    radiance_dtype: type, weights_dtype: type
) -> None:
    radiance, _ = batch(50, 9, radiance_dtype, 1)
    _, weights = batch(50, 9, weights_dtype, 2)
    mean = resolve(radiance, weights)
    assert mean.shape == (3, 50)
    assert mean.dtype == np.promote_types(radiance_dtype, weights_dtype)
    assert np.abs(mean - exact_mean(radiance, weights)).max() <= 9 * np.finfo(mean.dtype).eps


@dtypes
def test_resolve_does_not_depend_on_the_weights_scale(dtype: type) -> None:
    radiance, weights = batch(20, 16, dtype)
    expected = exact_mean(radiance, weights)
    # A narrow gaussian's weights may be whole multiples of the least float.
    least = np.finfo(dtype).smallest_subnormal
    for scaled in (weights * dtype(1e-30), weights * dtype(1e-6), weights * dtype(1e6)):
        assert resolve(radiance, scaled) == pytest.approx(expected, rel=1e-5)
    counts = np.ceil(weights * 5)
    assert resolve(radiance, counts * least) == pytest.approx(
        exact_mean(radiance, counts), rel=1e-5
    )


@dtypes
def test_weights_that_sum_to_zero_give_the_plain_mean_in_their_pixels_only(dtype: type) -> None:
    radiance, weights = batch(4, 8, dtype)
    weights[1] = 0
    weights[2] = [1, -1, 2, -2, 0.5, -0.5, 0, 0]
    mean = resolve(radiance, weights)
    assert mean.dtype == dtype
    for pixel in (1, 2):
        assert mean[:, pixel] == pytest.approx(radiance[:, pixel].mean(axis=1), rel=1e-6)
    expected = exact_mean(radiance[:, [0, 3]], weights[[0, 3]])
    assert mean[:, [0, 3]] == pytest.approx(expected, rel=1e-6)


def test_resolve_is_accurate_for_the_most_samples_that_a_scene_may_ask_for() -> None:
    radiance, weights = batch(2, 65536)
    assert resolve(radiance, weights) == pytest.approx(exact_mean(radiance, weights), rel=1e-4)
