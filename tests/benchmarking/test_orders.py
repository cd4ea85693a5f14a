"""Fitted orders: exact on power laws, with intervals that hold as often as they say."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

from course.benchmarking.curves import ConvergenceOrder, fit_order

SAMPLES = np.array([1, 4, 16, 64, 256, 1024], float)


def law(order: float, scale: float = 1.0, seeds: int = 4) -> np.ndarray:
    """(n, seeds) squared errors that follow a power law exactly."""
    return np.repeat((scale * SAMPLES**order)[:, None] ** 2, seeds, axis=1)


@given(order=st.floats(-2, 0), scale=st.floats(1e-6, 1e3))
def test_the_order_of_a_power_law(order: float, scale: float) -> None:
    fitted = fit_order(SAMPLES, law(order, scale))
    assert fitted is not None
    assert fitted.value == pytest.approx(order, abs=1e-9)
    assert fitted.low == pytest.approx(order, abs=1e-6)
    assert fitted.high == pytest.approx(order, abs=1e-6)
    assert (fitted.first, fitted.last) == (4, 1024)


def test_the_first_sample_does_not_count() -> None:
    mse = law(-0.5)
    mse[0] *= 100
    fitted = fit_order(SAMPLES, mse)
    assert fitted is not None
    assert fitted.value == pytest.approx(-0.5)


def test_errors_near_the_reference_s_own_do_not_count() -> None:
    # The reference's error adds to all; below 4 times of it the slope would flatten.
    floor = 0.02
    mse = law(-0.5) + floor**2
    fitted = fit_order(SAMPLES, mse, floor)
    assert fitted is not None
    assert fitted.last == 64
    # At 4 times the floor the squared error is off by 1/16 at most, half of that in RMSE, over log 16.
    assert fitted.value == pytest.approx(-0.5, abs=0.5 * math.log(1 + 1 / 16) / math.log(16))


@pytest.mark.parametrize("floor", [0.2, 10.0])
def test_too_few_errors_above_the_floor_have_no_order(floor: float) -> None:
    assert fit_order(SAMPLES, law(-0.5), floor) is None


def test_two_points_are_too_few_and_no_error_has_no_order() -> None:
    assert fit_order(SAMPLES[:3], law(-0.5)[:3]) is None
    assert fit_order(SAMPLES, np.zeros((6, 4))) is None


def test_one_seed_tells_nothing_about_noise() -> None:
    fitted = fit_order(SAMPLES, law(-0.75, seeds=1))
    assert fitted is not None
    assert fitted.value == pytest.approx(-0.75)
    assert (fitted.low, fitted.high) == (-math.inf, math.inf)


@pytest.mark.parametrize("seeds", [3, 4, 8])
def test_the_interval_holds_the_order_as_often_as_it_says(seeds: int) -> None:
    # Gaussian pictures of 200 values: a seed's mean squared error is chi-squared / 200 around the law. At a true
    # coverage of 92% or more, fewer than HELD of 300 has a chance below 1e-6.
    trials = 300
    least = int(stats.binom.ppf(1e-6, trials, 0.92))
    rng = np.random.default_rng(20)
    held = 0
    for _ in range(trials):
        noise = rng.chisquare(200, (len(SAMPLES), seeds)) / 200
        fitted = fit_order(SAMPLES, law(-0.7, seeds=seeds) * noise)
        assert isinstance(fitted, ConvergenceOrder)
        held += fitted.low <= -0.7 <= fitted.high
    assert held >= least


def test_the_interval_shrinks_as_seeds_are_added() -> None:
    # By the square root of their number and Student's t; between 4 and 64 seeds by 3.18 / 2.00 * 4 = 6.4 on average.
    rng = np.random.default_rng(3)
    widths = {}
    for seeds in (4, 64):
        fits = [
            fit_order(SAMPLES, law(-0.5, seeds=seeds) * rng.chisquare(50, (6, seeds)) / 50)
            for _ in range(20)
        ]
        widths[seeds] = np.mean([fit.high - fit.low for fit in fits if fit])
    assert 4 < widths[4] / widths[64] < 9
