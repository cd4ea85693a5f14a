"""Importance sampling: densities integrate to 1, and one proportional to the integrand leaves no variance."""

import math

import numpy as np
import pytest

from course.school.grading.checks.laws import DTYPES
from tests.school.solutions.contract import SOLUTIONS, frozen, unit

cosine_hemisphere = SOLUTIONS.function("importance_sampling", "cosine_hemisphere")
cosine_hemisphere_pdf = SOLUTIONS.function("importance_sampling", "cosine_hemisphere_pdf")
phong_lobe_pdf = SOLUTIONS.function("importance_sampling", "phong_lobe_pdf")
estimate = SOLUTIONS.function("importance_sampling", "estimate")


dtypes = pytest.mark.parametrize("dtype", DTYPES)


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


def test_a_density_proportional_to_the_integrand_leaves_no_variance() -> None:
    cos = cosine_hemisphere(unit(2, 1000, np.float64, seed=3))[2]
    mean, variance = estimate(cos, cosine_hemisphere_pdf(cos))
    assert mean == pytest.approx(math.pi, rel=1e-14)
    assert variance < 1e-30


@pytest.mark.parametrize(("f", "pdf"), [((), (1,)), ((1, 2, 3), (3,)), ((3, 4), (3,)), ((4,), ())])
def test_other_shapes_are_refused(f: tuple[int, ...], pdf: tuple[int, ...]) -> None:
    with pytest.raises(ValueError, match=r"^(f|pdf) must have shape "):
        estimate(np.ones(f), np.ones(pdf))
