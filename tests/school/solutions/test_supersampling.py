"""Antialiasing: point patterns of a pixel, Gaussian weights, and the weighted mean."""

from collections.abc import Callable

import numpy as np
import pytest

from course.school.grading.checks.laws import DTYPES
from tests.school.solutions.contract import SOLUTIONS, Array

regular = SOLUTIONS.function("supersampling", "regular")
random = SOLUTIONS.function("supersampling", "random")
jittered = SOLUTIONS.function("supersampling", "jittered")
resolve = SOLUTIONS.function("supersampling", "resolve")

PATTERNS: dict[str, Callable[[int, int, int], Array]] = {
    "regular": lambda k, n, _seed: regular(k, n),
    "random": lambda k, n, seed: random(k, n, np.random.default_rng(seed)),
    "jittered": lambda k, n, seed: jittered(k, n, np.random.default_rng(seed)),
}

pattern = pytest.mark.parametrize("name", PATTERNS)
dtypes = pytest.mark.parametrize("dtype", DTYPES)


def exact_mean(radiance: Array, weights: Array) -> Array:
    """The weighted mean in float64."""
    radiance, weights = radiance.astype(float), weights.astype(float)
    return (radiance * weights).sum(axis=2) / weights.sum(axis=1)


def batch(n: int, s: int, dtype: type = np.float32, seed: int = 0) -> tuple[Array, Array]:
    """Radiance and weights."""
    rng = np.random.default_rng(seed)
    return rng.random((3, n, s), dtype), rng.random((n, s), dtype)


@pattern
@pytest.mark.parametrize("number", [np.int64, np.uint16])
def test_numpy_integers_are_integers(name: str, number: type) -> None:
    assert (PATTERNS[name](number(3), number(2), 1) == PATTERNS[name](3, 2, 1)).all()


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


def test_resolve_is_accurate_for_the_most_samples_that_a_scene_may_ask_for() -> None:
    radiance, weights = batch(2, 65536)
    assert resolve(radiance, weights) == pytest.approx(exact_mean(radiance, weights), rel=1e-4)
