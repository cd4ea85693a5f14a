"""Importance sampling: directions, their densities, the estimate with its variance, and the power heuristic."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import product

import numpy as np
import pytest

from course.grading.checks.laws import DTYPES
from tests.solutions.contract import (
    SOLUTIONS,
    Array,
    assert_mean,
    assert_uniform,
    assert_unit,
    frozen,
    unit,
    worst_units,
)

uniform_hemisphere = SOLUTIONS.function("importance_sampling", "uniform_hemisphere")
cosine_hemisphere = SOLUTIONS.function("importance_sampling", "cosine_hemisphere")
cosine_hemisphere_pdf = SOLUTIONS.function("importance_sampling", "cosine_hemisphere_pdf")
phong_lobe_pdf = SOLUTIONS.function("importance_sampling", "phong_lobe_pdf")
estimate = SOLUTIONS.function("importance_sampling", "estimate")
power_heuristic = SOLUTIONS.function("importance_sampling", "power_heuristic")
sample_phong_lobe = SOLUTIONS.function("glossy", "sample_phong_lobe")

N = 100_000

dtypes = pytest.mark.parametrize("dtype", DTYPES)


def turn(directions: Array) -> Array:
    return np.arctan2(directions[1], directions[0]) / (2 * np.pi) % 1


# ---------------------------------------------------------------- directions and densities


@dtypes
@pytest.mark.parametrize(("function", "power"), [(uniform_hemisphere, 1), (cosine_hemisphere, 2)])
def test_directions_have_their_density(
    dtype: type, function: Callable[[Array], Array], power: int
) -> None:
    directions = function(unit(2, N, dtype, seed=1)).astype(float)
    assert_unit(directions, 1e-6)
    # Of the hemisphere the share above height z is 1 - z, or 1 - z^2 with the cosine's density.
    assert_uniform(np.stack((directions[2] ** power, turn(directions))), (24, 24))


@dtypes
@pytest.mark.parametrize("function", [uniform_hemisphere, cosine_hemisphere])
def test_directions_are_above_the_horizon_for_the_worst_numbers(
    dtype: type, function: Callable[[Array], Array]
) -> None:
    worst = worst_units(2, dtype)
    directions = function(np.concatenate((worst, np.ones_like(worst)), axis=1))
    assert_unit(directions, 1e-6)
    assert (directions[2] >= 0).all()


@dtypes
@pytest.mark.parametrize("exponent", [0.0, 0.5, 1.0, 7.0, 200.0])
def test_densities_are_their_formula_and_integrate_to_1(dtype: type, exponent: float) -> None:
    nodes, weights = np.polynomial.legendre.leggauss(200)
    cos = ((nodes + 1) / 2).astype(dtype)
    found = phong_lobe_pdf(frozen(cos), exponent)
    exact = (exponent + 1) / (2 * np.pi) * cos.astype(float) ** exponent
    eps = float(np.finfo(dtype).eps)
    assert np.abs(found - exact).max() <= 4 * eps * (1 + exponent)
    assert np.pi * float(found @ weights) == pytest.approx(1, rel=1e-4)
    if exponent == 1:
        assert cosine_hemisphere_pdf(cos) == pytest.approx(exact, rel=4 * eps)
    assert (phong_lobe_pdf(-cos, exponent) == 0).all()
    assert (cosine_hemisphere_pdf(-cos) == 0).all()


@dtypes
def test_phong_density_has_the_limits_of_its_formula(dtype: type) -> None:
    cos = np.array([-1, 0, 0.5, 1, 1 + 2 * np.finfo(dtype).eps], dtype)
    assert phong_lobe_pdf(cos, 0.0) * 2 * np.pi == pytest.approx([0, 1, 1, 1, 1])
    density = phong_lobe_pdf(cos, 1e6)
    assert np.isfinite(density).all()
    assert (density[:3] == 0).all()
    assert (density[3:] > 1e5).all()


@pytest.mark.parametrize("wrong", [-1.0, -1e-9, math.nan])
def test_an_exponent_out_of_range_is_refused(wrong: float) -> None:
    with pytest.raises(ValueError, match=f"^exponent must be >= 0, got {wrong}$"):
        phong_lobe_pdf(np.ones(3), wrong)


# ---------------------------------------------------------------- the estimate


def central(n: int, lobe: int, order: int) -> float:
    """A central moment of cos^n / pdf for directions of a Phong lobe."""
    mean, scale = 2 * math.pi / (n + 1), 2 * math.pi / (lobe + 1)
    return sum(
        math.comb(order, k)
        * (-mean) ** (order - k)
        * scale**k
        * (lobe + 1)
        / (k * (n - lobe) + lobe + 1)
        for k in range(order + 1)
    )


@pytest.mark.parametrize("n", [3, 6])
def test_the_same_integral_with_the_variance_that_each_density_leaves(n: int) -> None:
    u = unit(2, N, np.float64, seed=2)
    axis = np.tile(np.array([[0.0], [0.0], [1.0]]), N)
    variances = []
    for lobe, cos in (
        (0, uniform_hemisphere(u)[2]),
        (1, cosine_hemisphere(u)[2]),
        (n - 1, sample_phong_lobe(axis, float(n - 1), u)[2]),
    ):
        f, pdf = cos**n, phong_lobe_pdf(cos, float(lobe))
        variance = central(n, lobe, 2)
        assert_mean(f / pdf, 2 * math.pi / (n + 1), variance)
        mean, found = estimate(f, pdf)
        assert mean == pytest.approx((f / pdf).mean(), rel=1e-12)
        off = (f / pdf - 2 * math.pi / (n + 1)) ** 2
        assert_mean(off, variance, central(n, lobe, 4) - variance**2)
        assert found * N == pytest.approx(off.mean(), rel=1e-3)
        variances.append(found)
    assert variances[0] > 1.5 * variances[1] > 2 * variances[2]


def test_a_density_proportional_to_the_integrand_leaves_no_variance() -> None:
    cos = cosine_hemisphere(unit(2, 1000, np.float64, seed=3))[2]
    mean, variance = estimate(cos, cosine_hemisphere_pdf(cos))
    assert mean == pytest.approx(math.pi, rel=1e-14)
    assert variance < 1e-30


@pytest.mark.parametrize(("f_dtype", "pdf_dtype"), [*product(DTYPES, repeat=2)])
@pytest.mark.parametrize("shape", [(50,), (3, 50), (1, 2), (0, 5)])
def test_estimate_is_the_mean_and_its_unbiased_variance(
    f_dtype: type, pdf_dtype: type, shape: tuple[int, ...]
) -> None:
    rng = np.random.default_rng(4)
    f, pdf = rng.random(shape).astype(f_dtype), rng.uniform(0.5, 2, shape[-1]).astype(pdf_dtype)
    mean, variance = estimate(frozen(f), frozen(pdf))
    value = f.astype(float) / pdf
    for found, exact in (
        (mean, value.mean(axis=-1)),
        (variance, value.var(axis=-1, ddof=1) / shape[-1]),
    ):
        assert found.shape == shape[:-1]
        assert found.dtype == np.result_type(f_dtype, pdf_dtype)
        assert found == pytest.approx(exact, rel=1e-6)


def test_samples_of_no_density_count_0() -> None:
    f, pdf = np.array([0.0, 3.0, 0.0, 1.0]), np.array([0.0, 1.0, 0.0, 1.0])
    mean, variance = estimate(f, pdf)
    assert mean == 1
    assert variance == pytest.approx((1 + 4 + 1 + 0) / 3 / 4)


def test_a_small_variance_is_not_lost_beside_a_large_mean() -> None:
    f = np.float32(4000) + unit(1, 1000, np.float32, seed=5)[0]
    _, variance = estimate(f, np.ones_like(f))
    assert variance == pytest.approx(f.astype(float).var(ddof=1) / 1000, rel=1e-6)


def test_the_estimate_of_few_samples_is_finite() -> None:
    for n, expected in ((0, 0.0), (1, 2.0)):
        for shape in ((n,), (3, n)):
            mean, variance = estimate(np.ones(shape), np.full(n, 0.5))
            assert (mean == expected).all()
            assert (variance == 0).all()


@pytest.mark.parametrize("wrong", [-1.0, math.nan])
def test_a_negative_density_is_refused(wrong: float) -> None:
    bad, good = np.array([1.0, wrong]), np.ones(2)
    for function, arguments, name in (
        (estimate, (good, bad), "pdf"),
        (power_heuristic, (bad, good), "a"),
        (power_heuristic, (good, bad), "b"),
    ):
        with pytest.raises(ValueError, match=f"^{name} must be >= 0, got {wrong}$"):
            function(*arguments)


def test_a_value_without_a_density_is_refused() -> None:
    with pytest.raises(ValueError, match=r"^pdf must be > 0 where f is not 0$"):
        estimate(np.ones((3, 2)), np.array([1.0, 0.0]))


@pytest.mark.parametrize(("f", "pdf"), [((), (1,)), ((1, 2, 3), (3,)), ((3, 4), (3,)), ((4,), ())])
def test_other_shapes_are_refused(f: tuple[int, ...], pdf: tuple[int, ...]) -> None:
    with pytest.raises(ValueError, match=r"^(f|pdf) must have shape "):
        estimate(np.ones(f), np.ones(pdf))


# ---------------------------------------------------------------- the power heuristic


@dtypes
@pytest.mark.parametrize("scale", [1e-6, 1e-3, 1.0, 1e3, 1e6])
def test_weights_depend_on_the_ratio_alone(dtype: type, scale: float) -> None:
    a, b = np.array([[1, 3, 1, 2, 0, 0], [1, 1, 2, 0, 2, 0]], dtype) * dtype(scale)
    assert power_heuristic(a, b) == pytest.approx([0.5, 0.9, 0.2, 1, 0, 0], rel=1e-6)
    assert power_heuristic(b, a) == pytest.approx([0.5, 0.1, 0.8, 0, 1, 0], rel=1e-6)


def test_two_densities_together_count_each_direction_once() -> None:
    """Samples of both, weighted, add up to the integral."""
    n = 4
    total = np.zeros(N)
    for k, function in enumerate((uniform_hemisphere, cosine_hemisphere)):
        cos = function(unit(2, N, np.float64, seed=6 + k))[2]
        pdfs = [np.full(N, 1 / (2 * math.pi)), cosine_hemisphere_pdf(cos)]
        own, other = pdfs[k], pdfs[1 - k]
        total += power_heuristic(own, other) * cos**n / own
    # The variance is estimated from the samples, for which there are enough.
    assert_mean(total, 2 * math.pi / (n + 1), float(total.var()))
