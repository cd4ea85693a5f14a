"""Which pixels get more samples: the best allocation under the model of the variance, and the rungs near it."""

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from course.engine.render.adaptive.allocation import (
    FIRST_OF_NET,
    LADDER,
    LONGEST,
    best_samples,
    growth,
    next_rung,
    one_rung_more,
)
from course.engine.render.adaptive.film import PARTS

Array = NDArray[Any]
ORDERS = (0.5, 0.6, 0.75)
P = 500


def picture(seed: int) -> tuple[Array, Array]:
    """Variances over eight powers of ten, some of them 0, and samples on the ladder that follow them loosely."""
    rng = np.random.default_rng(seed)
    variance = (10.0 ** rng.uniform(-9, -1, P)).astype(np.float32)
    variance[rng.random(P) < 0.1] = 0
    return variance, LADDER.take(rng.integers(0, 12, P))


def variance_with(variance: Array, samples: Array, more: Array, order: float) -> Array:
    """The variances of (P,) pixels after they have got more samples."""
    return np.asarray(variance * (samples / np.maximum(more, samples)) ** (2 * order), float)


def costs(seed: int) -> NDArray[np.float32]:
    """(P,) what a sample costs: one ray, or up to thirty."""
    return np.exp(np.random.default_rng((seed, 1)).uniform(0, 3.4, P)).astype(np.float32)


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("part", [0.9, 0.3, 1e-2, 1e-5])
def test_the_best_samples_bring_the_variance_to_the_target(part: float, order: float) -> None:
    variance, samples = picture(1)
    target = part * float(variance.mean())
    best = best_samples(variance, samples, costs(1), order, target)
    assert best.dtype == np.float32
    left = variance_with(variance, samples, best, order).mean()
    assert left == pytest.approx(target, rel=1e-4)


@pytest.mark.parametrize("order", ORDERS)
def test_a_picture_that_is_good_enough_wants_nothing(order: float) -> None:
    variance, samples = picture(2)
    for slack in (1.001, 2, 1e6):
        best = best_samples(variance, samples, costs(2), order, slack * float(variance.mean()))
        assert (best <= samples * (1 + 1e-6)).all()


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("part", [0.5, 1e-2])
def test_one_more_sample_gains_the_same_wherever_samples_go(part: float, order: float) -> None:
    """The conditions of Karush, Kuhn and Tucker: gains are to costs alike where samples grow, and less elsewhere."""
    variance, samples = picture(3)
    cost = costs(3)
    best = best_samples(variance, samples, cost, order, part * float(variance.mean()))
    best = best.astype(float)
    growing = best > samples
    assert 20 < growing.sum() < P
    have = np.maximum(best, samples)
    gain = 2 * order * variance_with(variance, samples, best, order) / (have * cost)
    assert np.ptp(gain[growing]) < 1e-4 * gain[growing].mean()
    assert gain[~growing].max() <= gain[growing].mean() * (1 + 1e-4)


@pytest.mark.parametrize("order", ORDERS)
def test_no_other_way_to_spend_as_much_is_better(order: float) -> None:
    variance, samples = picture(4)
    cost = costs(4)
    best = best_samples(variance, samples, cost, order, 0.05 * float(variance.mean()))
    have = np.maximum(best, samples).astype(float)
    least = variance_with(variance, samples, have, order).sum()
    rng = np.random.default_rng(5)
    for size in (1e-3, 0.1, 0.5, 3.0):
        for _ in range(100):
            extra = (have - samples) * np.exp(rng.normal(0, size, P))
            extra += rng.random() * size * rng.exponential(1, P) * (rng.random(P) < 0.2)
            other = samples + extra * ((cost * (have - samples)).sum() / (cost * extra).sum())
            assert variance_with(variance, samples, other, order).sum() >= least * (1 - 1e-9)


def test_independent_samples_in_closed_form() -> None:
    # Where all grow, n = sqrt(v / c) sum(sqrt(v c)) / target, v of one sample each (Neyman 1934).
    one = np.array([1, 4, 9, 16, 100], np.float32)
    samples = np.full(5, 16, np.int32)
    for cost in (np.ones(5, np.float32), np.array([16, 1, 4, 9, 25], np.float32)):
        best = best_samples(one / 16, samples, cost, 0.5, 0.01)
        expected = np.sqrt(one / cost) * np.sqrt(one * cost).sum() / (5 * 0.01)
        assert best == pytest.approx(expected, rel=1e-5)


@pytest.mark.parametrize("order", ORDERS)
def test_the_unit_of_costs_is_of_no_consequence(order: float) -> None:
    variance, samples = picture(6)
    target = 0.1 * float(variance.mean())
    best = best_samples(variance, samples, costs(6), order, target)
    same = best_samples(variance, samples, 1000 * costs(6), order, target)
    assert same == pytest.approx(best, rel=1e-5)


@pytest.mark.parametrize("order", ORDERS)
def test_noisier_pixels_and_smaller_targets_want_more(order: float) -> None:
    samples = np.full(40, 64, np.int32)
    variance = np.geomspace(1e-8, 1, 40).astype(np.float32)
    before = np.zeros(40, np.float32)
    for target in (1e-2, 1e-3, 1e-4):
        best = best_samples(variance, samples, np.ones(40, np.float32), order, target)
        assert (np.diff(best) > 0).all()
        assert (best > before).all()
        before = best


def test_pixels_without_variance_want_nothing() -> None:
    samples = np.array([16, 64, 16], np.int32)
    variance = np.array([0, 0, 1], np.float32)
    best = best_samples(variance, samples, costs(0)[:3], 0.5, 0.01)
    assert best[:2].tolist() == [0, 0]
    assert best[2] == pytest.approx(16 / 0.03, rel=1e-5)
    for target in (0.0, 1e-9, 1.0):
        nothing = np.zeros(3, np.float32)
        assert not best_samples(nothing, samples, costs(0)[:3], 0.5, target).any()


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("target", [0.0, 1e-320, 1e-40, 1e-6, 1e30])
def test_any_range_of_variances_and_any_target_give_finite_numbers(
    target: float, order: float
) -> None:
    variance = np.array([0, 1e-30, 1e-20, 1e-3, 1, 1e12, 1e30], np.float32)
    samples = np.array([16, 16, 64, 24, 1024, 65536, 2048], np.int32)
    best = best_samples(variance, samples, costs(0)[:7], order, target)
    assert np.isfinite(best).all()
    assert (best >= 0).all()
    assert np.isin(next_rung(samples, best), LADDER).all()
    left = variance_with(variance, samples, best, order)
    # Either the target is met or every pixel with a variance is wanted at the top of the ladder.
    top = (best[1:] >= LADDER[-1] * (1 - 1e-5)).all()
    assert top or left.mean() <= target * (1 + 1e-4)


def test_the_ladder_has_few_rungs_that_suit_the_points() -> None:
    assert LADDER[0] == FIRST_OF_NET
    assert LADDER[-1] == 65536
    steps = np.diff(LADDER)
    assert steps.min() > 0
    assert steps.max() == LONGEST
    assert (steps <= np.maximum(LADDER[:-1] / 2, PARTS)).all()
    assert set(2 ** np.arange(3, 17)) <= set(LADDER.tolist()), "where the points are most even"
    assert not (LADDER % PARTS).any(), "each stretch can be quartered"


def test_only_rungs_of_the_ladder_are_reached_from_a_rung() -> None:
    samples = np.repeat(LADDER, 400)
    best = np.tile(np.geomspace(1e-3, 1e6, 400), len(LADDER)).astype(np.float32)
    after = next_rung(samples, best)
    assert after.dtype == np.int32
    assert set(after.tolist()) <= set(LADDER.tolist())
    assert (after >= samples).all()
    assert (after <= growth(samples) * samples).all()
    assert (after <= samples + LONGEST).all()
    by_rung = after.reshape(len(LADDER), -1)
    assert (np.diff(by_rung, axis=1) >= 0).all(), "who wants more gets as much or more"
    assert (np.diff(by_rung, axis=0) >= 0).all()


def test_what_is_in_reach_is_rounded_to_the_nearest_rung_by_ratio() -> None:
    rng = np.random.default_rng(7)
    best = rng.integers(16, 1000, 6000).astype(np.float32)
    samples = LADDER.take(rng.integers(0, 14, 6000))
    free = (best > samples) & (best < growth(samples) * samples) & (best < samples + LONGEST / 2)
    ratio = np.abs(np.log(best[:, None] / LADDER[None]))
    nearest = LADDER.take(ratio.argmin(axis=1))
    assert free.sum() > 500
    assert np.array_equal(next_rung(samples, best)[free], np.maximum(nearest, samples)[free])


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("excess", [1e-12, 1e-3, 0.05, 0.3])
def test_at_the_end_only_as_many_pixels_go_up_as_are_needed(excess: float, order: float) -> None:
    variance, samples = picture(8)
    cost = costs(8)
    after = one_rung_more(samples, variance, cost, order, excess)
    up = after > samples
    assert np.array_equal(np.searchsorted(LADDER, after), np.searchsorted(LADDER, samples) + up)
    assert set(after.tolist()) <= set(LADDER.tolist())
    above = LADDER.take(np.searchsorted(LADDER, samples) + 1)
    gain = variance - variance_with(variance, samples, above, order)
    assert gain[up].sum() >= excess * (1 - 1e-6)
    worth = gain / (cost * (above - samples))
    assert worth[up].min() >= worth[~up].max() * (1 - 1e-6), "the best bargains first"
    last = np.flatnonzero(up)[worth[up].argmin()]
    assert gain[up].sum() - gain[last] < excess * (1 + 1e-6), "and not one too many"


def test_nothing_goes_up_that_gains_nothing() -> None:
    samples = np.array([16, LADDER[-1], 24], np.int32)
    variance = np.array([0, 1, 1e-6], np.float32)
    cost = costs(0)[:3]
    assert one_rung_more(samples, variance, cost, 0.5, 1.0).tolist() == [16, LADDER[-1], 32]
    nothing = np.zeros(3, np.float32)
    assert np.array_equal(one_rung_more(samples, nothing, cost, 0.5, 1.0), samples)
