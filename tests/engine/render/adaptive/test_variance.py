"""What a squared difference says of a variance: closed forms, and noise whose sums spread as the model says.

Fractional Gaussian noise of Hurst exponent 1 - a (Mandelbrot & Van Ness 1968) has sums of n numbers with the variance
n^(2 - 2a), wherever they begin: exactly the model. Its squared differences are averaged over SERIES independent series;
such a mean has a relative standard deviation of sqrt(2 / SERIES), and 5.5 of them are left as room: each of the 18
comparisons fails by chance once in 2e7.
"""

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from course.engine.render.adaptive.variance import (
    BELIEVED,
    EXPECTED,
    INDEPENDENT,
    measured_order,
    variance_share,
)

ORDERS = (0.5, 0.55, 0.6, 0.75, 0.9, 1.0)
SIZES = [(4, 4, 16), (8, 8, 16), (16, 8, 24), (24, 24, 48), (1024, 1024, 2048), (5, 11, 64)]
SERIES = 20000
MANY = 1e18
"""Pixels, so that only what is measured counts."""

ROOM = 5.5 * math.sqrt(2 / SERIES)


@pytest.mark.parametrize(("n", "m", "total"), SIZES)
def test_of_independent_samples_it_is_the_textbook_formula(n: int, m: int, total: int) -> None:
    share = variance_share(n, m, total, INDEPENDENT)
    assert share == pytest.approx((1 / total) / (1 / n + 1 / m), rel=1e-12)


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("n", [1, 4, 100])
def test_quarters_and_halves_in_closed_form(order: float, n: int) -> None:
    # (A - B)^2 of two parts of n: V(n) (4 - 4 r), where r = 2^-2a turns V(n) into V(2 n).
    r = 2 ** (-2 * order)
    assert variance_share(n, n, n, order) == pytest.approx(1 / (4 - 4 * r))
    assert variance_share(n, n, 2 * n, order) == pytest.approx(r / (4 - 4 * r))
    assert variance_share(n, n, 4 * n, order) == pytest.approx(r * r / (4 - 4 * r))


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize(("n", "m", "total"), SIZES)
def test_two_parts_make_their_mean(n: int, m: int, total: int, order: float) -> None:
    """The mean of the squares of two means is the square of the mean and what they lie apart (Steiner)."""

    def variance(k: int) -> float:
        return float(k) ** (-2 * order)

    mean_square = (n * variance(n) + m * variance(m)) / (n + m)
    apart = (mean_square - variance(n + m)) * (n + m) ** 2 / (n * m)
    share = variance_share(n, m, total, order)
    assert share == pytest.approx(variance(total) / apart, rel=1e-9)
    assert share == variance_share(m, n, total, order)


def noise(order: float, length: int) -> NDArray[np.float64]:
    """(SERIES, length): the variance of the mean of any n in a row is n^-2a."""
    lag = np.abs(np.subtract.outer(np.arange(length), np.arange(length))).astype(float)
    power = 2 - 2 * order
    covariance = ((lag + 1) ** power + np.abs(lag - 1) ** power) / 2 - lag**power
    white = np.random.default_rng(8).standard_normal((SERIES, length))
    return white @ np.linalg.cholesky(covariance).T


@pytest.mark.parametrize("order", [0.5, 0.6, 0.75])
@pytest.mark.parametrize(("n", "m"), [(4, 4), (8, 8), (16, 8), (8, 24), (1, 31), (12, 20)])
def test_noise_that_follows_the_model_is_judged_right(n: int, m: int, order: float) -> None:
    series = noise(order, 32)
    apart = series[:, :n].mean(axis=1) - series[:, n : n + m].mean(axis=1)
    estimate = np.mean(apart**2) * variance_share(n, m, 32, order)
    assert estimate == pytest.approx(32 ** (-2 * order), rel=ROOM)


@pytest.mark.parametrize("order", [0.5, 0.8])
def test_the_fewer_pixels_tell_an_order_the_less_it_counts(order: float) -> None:
    expected = INDEPENDENT + BELIEVED * (EXPECTED - INDEPENDENT)
    assert measured_order(2 ** (-2 * order), 1.0, 1e-6) == pytest.approx(expected, abs=1e-5)
    found = [measured_order(2 ** (-2 * order), 1.0, pixels) for pixels in (1, 100, 1e4)]
    apart = [abs(one - expected) for one in found]
    assert apart == sorted(apart)
    # On a hundred pixels it is measured to 0.12, which is how far scenes are apart.
    assert found[1] == pytest.approx((expected + measured_order(2 ** (-2 * order), 1.0, MANY)) / 2)


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("quarters", [1e-12, 0.3, 1e9])
def test_a_measured_order_is_believed_in_part(order: float, quarters: float) -> None:
    found = measured_order(quarters * 2 ** (-2 * order), quarters, MANY)
    assert found == pytest.approx(INDEPENDENT + BELIEVED * (order - INDEPENDENT), abs=1e-12)


@pytest.mark.parametrize(
    ("halves", "quarters", "order"),
    [
        (1.0, 1.0, 0.5),  # the halves are as far apart as the quarters
        (9.0, 1.0, 0.5),
        (1e-9, 1.0, 0.95),  # the quarters cancel each other
        (0.0, 1.0, 0.5),
        (1.0, 0.0, 0.5),
        (0.0, 0.0, 0.5),
    ],
)
def test_an_order_is_never_worse_than_independent_nor_better_than_one(
    halves: float, quarters: float, order: float
) -> None:
    assert measured_order(halves, quarters, MANY) == pytest.approx(order, abs=1e-12)
