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


dtypes = pytest.mark.parametrize("dtype", DTYPES)


# ---------------------------------------------------------------- directions and densities


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


@pytest.mark.parametrize("wrong", [-1.0, -1e-9, math.nan])
def test_an_exponent_out_of_range_is_refused(wrong: float) -> None:
    with pytest.raises(ValueError, match=f"^exponent must be >= 0, got {wrong}$"):
        phong_lobe_pdf(np.ones(3), wrong)


# ---------------------------------------------------------------- the estimate


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
