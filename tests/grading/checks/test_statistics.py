"""Distances between distributions by hand, and what a check of a distribution states of itself."""

from __future__ import annotations

import numpy as np
import pytest

from course.grading.checks.statistics import CLOSE, FALSE_FAIL, apart, distribution_check


def test_a_check_states_the_false_fails_of_all_its_comparisons() -> None:
    def run(_trial: object) -> None: ...

    check = distribution_check("point_on_disk", "uniform", "Points are uniform", run, 3)
    assert (check.function, check.name, check.title, check.run) == (
        "point_on_disk",
        "uniform",
        "Points are uniform",
        run,
    )
    assert check.kind == "distribution"
    assert check.points == 1.0
    assert check.false_fail == pytest.approx(3 * FALSE_FAIL)


@pytest.mark.parametrize(
    ("values", "others", "distance"),
    [
        ([1.0, 2.0, 3.0], [3.0, 1.0, 2.0], 0.0),
        ([0.0, 1.0], [2.0, 3.0], 1.0),
        # Half of the first are below all of the second.
        ([0.0, 0.0, 5.0, 5.0], [4.0, 6.0], 0.5),
        # Ties count on both sides.
        ([1.0, 1.0, 1.0, 2.0], [1.0, 2.0, 2.0, 2.0], 0.5),
        ([1.0], [1.0, 2.0, 3.0, 4.0], 0.75),
    ],
)
def test_how_far_apart(values: list[float], others: list[float], distance: float) -> None:
    assert apart(np.array(values), np.array(others)) == pytest.approx(distance)
    assert apart(np.array(others), np.array(values)) == pytest.approx(distance)


def test_batches_of_one_distribution_are_close() -> None:
    """By Kolmogorov's limit, 2 exp(-2 n d^2) with n = 2000, one false fail in 100,000 or less at CLOSE."""
    assert 2 * np.exp(-2 * 2000 * CLOSE**2) < 1e-5
    rng = np.random.default_rng(0)
    assert apart(rng.random(4000), rng.random(4000)) < CLOSE


def test_how_far_apart_two_laws_are() -> None:
    """x^(5/6) - x is greatest at (5/6)^6."""
    u = (np.arange(10_000) + 0.5) / 10_000
    assert apart(u, u**1.2) == pytest.approx((5 / 6) ** 5 / 6, abs=2e-4)
