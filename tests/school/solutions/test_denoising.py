"""Denoising: Welch's test against SciPy's, its false rejections, and what means over neighbours keep."""

import numpy as np
import pytest
from scipy import stats

from tests.school.solutions.contract import SOLUTIONS, frozen

NAMES = ("welch_t", "degrees_of_freedom", "critical_value")
NAMES += ("pair_weights", "weighted_mean", "squared_bias")
welch_t, degrees_of_freedom, critical_value, pair_weights, weighted_mean, squared_bias = (
    SOLUTIONS.function("denoising", name) for name in NAMES
)


def moments(samples: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Means and sample variances (3, N) of samples (3, N, n), and their number."""
    count = np.full(samples.shape[1], float(samples.shape[2]))
    return frozen(samples.mean(axis=2)), frozen(samples.var(axis=2, ddof=1)), frozen(count)


@pytest.mark.parametrize(("n", "m"), [(2, 2), (2, 64), (4, 16), (100, 3)])
def test_statistic_and_degrees_are_those_of_scipy(n: int, m: int) -> None:
    rng = np.random.default_rng(n)
    a, b = rng.normal(1, 0.3, (3, 50, n)), rng.exponential(1, (3, 50, m))
    one, two = moments(a), moments(b)
    known = stats.ttest_ind(a, b, axis=2, equal_var=False)
    assert welch_t(*one, *two) == pytest.approx(known.statistic, rel=1e-12)
    assert degrees_of_freedom(*one[1:], *two[1:]) == pytest.approx(known.df, rel=1e-12)


@pytest.mark.parametrize("level", [1e-4, 0.001, 0.05, 0.3, 0.9])
def test_critical_values_are_those_of_scipy(level: float) -> None:
    degrees = np.concatenate((np.linspace(1, 12, 500), [50.0, 1e3, 1e6]))
    known = stats.t.ppf(1 - level / 2, degrees)
    assert critical_value(degrees, level) == pytest.approx(known, rel=5e-4)


@pytest.mark.parametrize("level", [0.01, 0.05, 0.2])
def test_equal_pixels_are_separated_as_often_as_the_level_says(level: float) -> None:
    # 300,000 comparisons: 0.004 is more than 5 standard errors, and 6 times what Welch's approximation is off by here.
    rng = np.random.default_rng(1)
    one, two = (moments(rng.normal(0.5, deviation, (3, 100_000, 8))) for deviation in (0.1, 0.2))
    t = welch_t(*one, *two)
    degrees = degrees_of_freedom(*one[1:], *two[1:])
    limits = critical_value(degrees.ravel(), level).reshape(t.shape)
    assert abs(float((np.abs(t) > limits).mean()) - level) < 0.004


def test_the_statistic_changes_its_sign_with_the_pixels() -> None:
    rng = np.random.default_rng(2)
    one, two = moments(rng.random((3, 40, 4))), moments(rng.random((3, 40, 9)))
    assert (welch_t(*one, *two) == -welch_t(*two, *one)).all()
    there, back = degrees_of_freedom(*one[1:], *two[1:]), degrees_of_freedom(*two[1:], *one[1:])
    assert there == pytest.approx(back, rel=1e-14)


def test_weights_are_symmetric() -> None:
    rng = np.random.default_rng(3)
    t, limits = rng.normal(0, 2, (3, 200)), np.full((3, 200), 2.0)
    distance = rng.uniform(0, 5, 200)
    weights = pair_weights(frozen(t), limits, distance, 1.5)
    assert (weights == pair_weights(frozen(-t), limits, distance, 1.5)).all()
    assert 0 < np.count_nonzero(weights) < 200


def test_symmetric_shares_keep_the_energy() -> None:
    # On a ring, where all pixels have the same distances, the sums of the weights are equal.
    rng = np.random.default_rng(4)
    pixels, offsets = rng.random((3, 32)), np.arange(-3, 4)
    others = (np.arange(32)[:, None] + offsets) % 32
    weights = np.tile(np.exp(-0.5 * (offsets / 1.5) ** 2), (32, 1))
    mean, _ = weighted_mean(pixels[:, others], np.ones((3, *others.shape)), weights)
    assert mean.sum(axis=1) == pytest.approx(pixels.sum(axis=1), rel=1e-13)
    assert mean.std() < 0.6 * pixels.std()


def test_a_filter_without_bias_is_estimated_to_have_none() -> None:
    # Equal pixels, fixed weights: a mean over 60,000, which is within 6 standard errors but once in 5e8 runs.
    rng = np.random.default_rng(5)
    variance = 0.04
    means = rng.normal(1, np.sqrt(variance), (3, 20_000, 5))
    weights = np.tile([2.0, 1, 1, 0.5, 0.5], (20_000, 1))
    filtered, left = weighted_mean(means, np.full_like(means, variance), weights)
    own = np.ascontiguousarray(means[..., 0])
    found = squared_bias(filtered, left, own, np.full_like(own, variance), weights[:, 0] / 5)
    assert abs(found.mean()) < 6 * found.std() / np.sqrt(found.size)
    moved = squared_bias(filtered + 0.3, left, own, np.full_like(own, variance), weights[:, 0] / 5)
    assert moved.mean() == pytest.approx(0.09, abs=0.01)
