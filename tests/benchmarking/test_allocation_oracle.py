"""The oracle of adaptive sampling, against closed forms."""

import numpy as np
import pytest

from benchmarks.allocation_oracle import STEPS, Beside, Oracle, table

LEVELS = np.repeat([1e-4, 1.0, 30.0], 200)


def oracle(levels: np.ndarray, order: float, cost: np.ndarray | None = None) -> Oracle:
    variance = levels * np.array(STEPS, float)[:, None] ** (-2 * order)
    return Oracle(
        np.stack((variance, variance)), 0.0, np.ones(len(levels)) if cost is None else cost
    )


@pytest.mark.parametrize("order", [0.5, 0.7])
def test_where_all_pixels_are_alike_it_needs_what_uniform_sampling_needs(order: float) -> None:
    alike = oracle(np.full(50, 2.0), order)
    assert alike.order == pytest.approx(order)
    for samples in (24, 64, 1000):
        error = float(np.sqrt(2 * samples ** (-2 * order)))
        assert alike.uniform(error) == pytest.approx(samples, rel=1e-3)
        assert alike.needs(error, False) == pytest.approx(samples, rel=1e-3)


@pytest.mark.parametrize("order", [0.5, 0.7])
def test_samples_as_the_level_to_one_over_two_orders_and_one(order: float) -> None:
    levels = LEVELS[200:]
    w = levels ** (1 / (2 * order + 1))
    error = 0.1
    needed = w.mean() ** (1 + 1 / (2 * order)) * error ** (-1 / order)
    assert oracle(levels, order).needs(error, False) == pytest.approx(needed, rel=2e-3)


def test_cost_is_spared_where_a_sample_costs_more() -> None:
    """With independent samples sum(sqrt(v c))^2 beside sum(sqrt(v)) sum(c sqrt(v))."""
    cost = np.tile([1.0, 9.0], 200)
    dear = oracle(LEVELS[200:], 0.5, cost)
    root, c = np.sqrt(LEVELS[200:]), cost / cost.mean()
    assert dear.needs(0.1, True) == pytest.approx((root * np.sqrt(c)).mean() ** 2 / 0.01, rel=2e-3)
    assert dear.needs(0.1, False) == pytest.approx(root.mean() ** 2 / 0.01, rel=2e-3)
    assert dear.spent(np.full(400, 7.0)) == pytest.approx(7)


def test_a_pixel_that_one_half_saw_by_chance_gains_nothing() -> None:
    """Levels that are noise alone: chosen by one half and judged by the other they save nothing."""
    noise = np.random.default_rng(1).exponential(size=(2, 1, 5000))
    variance = noise / np.array(STEPS, float)[:, None]
    error = 0.1
    found = Oracle(variance, 0.0, np.ones(5000))
    assert found.needs(error, False) > found.uniform(error)


def test_what_is_taken_is_a_product() -> None:
    one = Beside("x", 64, 2.0, 1.5, 1.1, 1.2, 1.05, 1.3, 1.1, 1.0)
    assert one.taken == pytest.approx(1.1 * 1.2 * 1.05)
    assert table([one]).rows[0][:5] == ("x", "64", "2.00", "1.50", "1.39")
