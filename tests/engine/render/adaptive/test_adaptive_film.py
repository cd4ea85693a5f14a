"""The adaptive film: weighted means of stretches of any length, and the estimate of their error.

Where numbers are compared exactly, they are multiples of 2^-10 and few enough that no sum is rounded.

The estimate of a pixel's variance is a random number itself, with a standard deviation that is measured over the
PIXELS pixels of a film; the mean over them may be 5.5 of its standard errors off, which it is by chance once in 2e7.
"""

import itertools
import math
import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import pytest
from numpy.typing import NDArray

from course.engine.core.tiles import Tile
from course.engine.render.adaptive import film as adaptive_film
from course.engine.render.adaptive.film import PARTS, AdaptiveFilm
from course.engine.render.adaptive.pixel_groups import PixelGroup
from course.engine.render.adaptive.variance import measured_order, variance_share

Array = NDArray[np.float64]
WIDTH, HEIGHT = 100, 80
PIXELS = WIDTH * HEIGHT
ENDS = (16, 24, 48, 64)


@dataclass
class Samples:
    """Of every pixel: values (3, P, n) and weights (P, n)."""

    values: Array
    weights: Array

    def stretch(self, pixels: NDArray[np.intp], first: int, last: int) -> tuple[Array, Array]:
        """Means and costs of 1 (4, p * PARTS), sums of weights (p * PARTS,), as a tracer hands them to the film."""
        w = self.weights[pixels, first:last].reshape(len(pixels) * PARTS, -1)
        x = self.values[:, pixels, first:last].reshape(3, *w.shape)
        total = w.sum(axis=1)
        mean = (x * w).sum(axis=2) / total
        return np.concatenate((mean, np.ones((1, *total.shape)))), total

    def mean(self, samples: int) -> Array:
        """(3, P) weighted mean of the first samples of each pixel."""
        w = self.weights[:, :samples]
        return np.asarray((self.values[..., :samples] * w).sum(axis=2) / w.sum(axis=1))


def everything(number: int = 0) -> PixelGroup:
    return PixelGroup(number, np.arange(PIXELS), WIDTH)


def add(
    film: AdaptiveFilm, samples: Samples, group: PixelGroup, first: int, last: int, box: bool = True
) -> None:
    mean, weight = samples.stretch(group.pixels, first, last)
    film.add(
        group,
        mean.astype(np.float32),
        float(weight[0]) if box else weight.astype(np.float32),
        last,
        True,
    )


def fill(samples: Samples, ends: Sequence[int] = ENDS, box: bool = True) -> AdaptiveFilm:
    film = AdaptiveFilm(WIDTH, HEIGHT)
    for first, last in itertools.pairwise((0, *ends)):
        add(film, samples, everything(), first, last, box)
    return film


def normal(seed: int, samples: int, deviation: Sequence[float] = (1, 2, 3)) -> Samples:
    """Independent numbers, of a deviation of its own in each channel."""
    values = np.random.default_rng(seed).standard_normal((3, PIXELS, samples))
    return Samples(values * np.reshape(deviation, (3, 1, 1)), np.ones((PIXELS, samples)))


def exact(seed: int, weighted: bool = False) -> Samples:
    """Quarters whose means and weights are multiples of 2^-10, whatever the stretch."""
    rng = np.random.default_rng(seed)
    values = np.repeat(rng.integers(0, 1024, (3, PIXELS, 32)) / 1024, 2, axis=2)
    weights = np.repeat(2.0 ** -rng.integers(0, 3, (PIXELS, 8)), 8, axis=1)
    return Samples(values, weights if weighted else np.ones((PIXELS, 64)))


def test_stretches_make_the_mean_of_all_samples_to_the_last_bit() -> None:
    samples = exact(1)
    film = AdaptiveFilm(WIDTH, HEIGHT)
    for first, last in itertools.pairwise((0, *ENDS)):
        add(film, samples, everything(), first, last)
        expected = samples.mean(last).astype(np.float32)
        assert np.array_equal(film.linear.reshape(3, -1), expected)
        assert (film.samples == last).all()
    assert film.linear.dtype == np.float32


def test_stretches_are_averaged_by_their_weights() -> None:
    samples = exact(2, weighted=True)
    film = fill(samples, box=False)
    # float64 sums, and one division that is rounded to float32.
    assert np.allclose(film.linear.reshape(3, -1), samples.mean(64), rtol=2**-23, atol=0)
    rng = np.random.default_rng(3)
    offsets = rng.random((2, PIXELS, 64)) - 0.5
    bell = Samples(rng.random((3, PIXELS, 64)), np.exp(-(offsets**2).sum(axis=0) * 18))
    film = fill(bell, box=False)
    assert np.allclose(film.linear.reshape(3, -1), bell.mean(64), rtol=1e-6, atol=0)


def test_how_large_all_weights_are_does_not_matter() -> None:
    samples = normal(4, 64)
    samples.weights = np.random.default_rng(4).integers(1, 8, (PIXELS, 64)).astype(float)
    film = fill(samples, box=False)
    for factor in (2.0**-60, 2.0**60):
        other = fill(Samples(samples.values, samples.weights * factor), box=False)
        assert np.array_equal(film.linear, other.linear)
        assert np.array_equal(film.variance, other.variance)


def test_weights_that_vanish_leave_the_plain_mean_and_yield_to_any_other() -> None:
    film = AdaptiveFilm(2, 1)
    group = PixelGroup(0, np.arange(2), 2)
    means = np.arange(1, 9, dtype=np.float32) / 8
    nothing = np.zeros(8, np.float32)
    film.add(group, np.stack((means, 2 * means, 4 * means, means)), nothing, 16, True)
    expected = means.reshape(2, PARTS).mean(axis=1)
    assert np.allclose(film.linear[:, 0], np.outer((1, 2, 4), expected), rtol=1e-6)
    assert (film.variance > 0).all()
    film.add(group, np.full((4, 8), 7, np.float32), nothing + np.float32(1e-20), 32, True)
    assert np.allclose(film.linear, 7, rtol=1e-6)


@pytest.mark.parametrize("ends", [(16,), (16, 24), (16, 64), (16, 24, 48, 64)])
def test_the_variance_of_independent_samples_is_estimated_without_bias(
    ends: tuple[int, ...],
) -> None:
    film = fill(normal(5, 64), ends)
    found = film.variance.astype(float).ravel()
    expected = (1 + 4 + 9) / 3 / ends[-1]
    error = found.std(ddof=1) / math.sqrt(PIXELS)
    assert abs(found.mean() - expected) < 5.5 * error
    assert error < 0.02 * expected, "or the test would tell nothing"
    assert film.error == pytest.approx(math.sqrt(found.mean()), rel=1e-6)


def test_pixels_are_judged_each_by_itself() -> None:
    samples = normal(6, 48)
    loud = np.arange(PIXELS) % 7 == 3
    samples.values[:, loud] *= 10
    samples.values[:, np.arange(PIXELS) % 7 == 5] = 0.25
    variance = fill(samples, (16, 24, 48)).variance.ravel()
    quiet = variance[np.arange(PIXELS) % 7 == 1]
    assert not variance[np.arange(PIXELS) % 7 == 5].any()
    assert variance[loud].mean() / quiet.mean() == pytest.approx(100, rel=0.2)


def noise(order: float, samples: int, seed: int) -> Samples:
    """Fractional Gaussian noise: the mean of any n numbers in a row has the variance n^-2a."""
    lag = np.abs(np.subtract.outer(np.arange(samples), np.arange(samples))).astype(float)
    power = 2 - 2 * order
    covariance = ((lag + 1) ** power + np.abs(lag - 1) ** power) / 2 - lag**power
    white = np.random.default_rng(seed).standard_normal((3, PIXELS, samples))
    values = white @ np.linalg.cholesky(covariance).T
    return Samples(values, np.ones((PIXELS, samples)))


@pytest.mark.parametrize("order", [0.5, 0.6, 0.75])
@pytest.mark.parametrize("ends", [(16,), (16, 32), (16, 24, 48)])
def test_with_the_right_order_samples_that_even_each_other_out_are_judged_right(
    monkeypatch: pytest.MonkeyPatch, order: float, ends: tuple[int, ...]
) -> None:
    monkeypatch.setattr(adaptive_film, "measured_order", lambda *_: order)
    film = AdaptiveFilm(WIDTH, HEIGHT)
    samples = noise(order, 48, 9)
    for first, last in itertools.pairwise((0, *ends)):
        add(film, samples, everything(), first, last)
        film.end_round()
    found = film.variance.astype(float).ravel()
    expected = ends[-1] ** (-2 * order)
    assert abs(found.mean() - expected) < 5.5 * found.std(ddof=1) / math.sqrt(PIXELS)
    assert film.order == order


def quarters(order: float, pixels: int) -> tuple[NDArray[np.float32], float]:
    """Means and costs (4, pixels * PARTS) whose halves are 2^-a as far apart as their quarters, and these squared."""
    half = 2 * 2**-order
    one = np.array([half + 1, half - 1, 1, -1], np.float32)
    return np.tile(one, (4, pixels)), 4.0


@pytest.mark.parametrize("order", [0.5, 0.7, 0.9])
def test_a_round_ends_with_the_order_of_its_own_stretches(order: float) -> None:
    film = AdaptiveFilm(8, 4)
    group = PixelGroup(0, np.arange(32), 8)
    means, _ = quarters(order, 32)
    film.add(group, means, 4.0, 16, True)
    assert film.order == 0.5, "nothing is known before the end of the round"
    film.end_round()
    assert film.order == pytest.approx(measured_order(4.0**-order, 1.0, 32), abs=1e-6)
    # The next round measures anew, and only what was added in it.
    rest = PixelGroup(1, np.arange(8), 8)
    film.add(rest, quarters(0.6, 8)[0], 2.0, 24, True)
    film.end_round()
    assert film.order == pytest.approx(measured_order(4.0**-0.6, 1.0, 8), abs=1e-6)


def test_the_order_of_independent_samples_is_not_measured() -> None:
    film = AdaptiveFilm(8, 4, net=False)
    film.add(PixelGroup(0, np.arange(32), 8), quarters(0.9, 32)[0], 4.0, 16, True)
    film.end_round()
    assert film.order == 0.5


@pytest.mark.parametrize("order", [0.5, 0.7, 0.9])
def test_the_first_round_is_judged_by_the_order_it_has_shown(
    monkeypatch: pytest.MonkeyPatch, order: float
) -> None:
    monkeypatch.setattr(adaptive_film, "measured_order", lambda *_: order)
    film = AdaptiveFilm(8, 4)
    means, apart = quarters(order, 32)
    film.add(PixelGroup(0, np.arange(32), 8), means, 4.0, 16, True)
    film.end_round()
    # Quarters and halves agree, so either says the same.
    by_quarters = apart * variance_share(4, 4, 16, order)
    by_halves = apart * 4**-order * variance_share(8, 8, 16, order)
    assert by_quarters == pytest.approx(by_halves)
    assert np.allclose(film.variance, by_quarters, rtol=1e-5)
    variance = film.variance.copy()
    film.add(PixelGroup(1, np.arange(16), 8), means[:, :64], 2.0, 24, True)
    film.end_round()
    assert np.array_equal(film.variance.ravel()[16:], variance.ravel()[16:]), "only the first is"


def test_what_a_sample_costs_is_the_mean_over_all_samples() -> None:
    film = AdaptiveFilm(3, 1)
    assert film.cost.tolist() == [[1, 1, 1]]
    rng = np.random.default_rng(3)
    before, total = 0, np.zeros(2)
    for number, samples in enumerate((16, 24, 64)):
        cost = 1 + rng.random(2)
        mean = np.concatenate((rng.random((3, 2 * PARTS)), np.repeat(cost, PARTS)[None]))
        group = PixelGroup(number, np.array([2, 0]), 3)
        film.add(group, mean.astype(np.float32), 1.0, samples, True)
        total += (samples - before) * cost
        before = samples
        assert film.cost[0, [2, 0]] == pytest.approx(total / samples, rel=1e-6)
    assert film.cost[0, 1] == 1


def test_groups_in_any_order_give_the_same_bits(monkeypatch: pytest.MonkeyPatch) -> None:
    pixels = np.random.default_rng(12).permutation(PIXELS)
    # Groups over six powers of ten, so that sums in another order are rounded otherwise.
    samples = noise(0.8, 48, 11)
    powers = np.repeat(np.random.default_rng(11).uniform(-3, 3, PIXELS // 250), 250)
    samples.values[:, pixels] *= 10.0 ** powers[:, None]
    rounds = [
        [(everything(), 0, 16)],
        [(0, 700, 16, 24), (700, 900, 16, 48), (900, 5000, 16, 32), (5000, 7777, 16, 24)],
        [(0, 700, 24, 48), (900, 2000, 32, 48), (2000, 4000, 32, 48)],
    ]
    rounds[0] = [(a, a + 250, 0, 16) for a in range(0, PIXELS, 250)]
    numbers = itertools.count()
    groups = [
        [(PixelGroup(next(numbers), pixels[a:b], WIDTH), first, last) for a, b, first, last in work]
        for work in rounds
    ]

    sums: list[tuple[float, ...]] = []

    def noted(*of_parts: float) -> float:
        sums.append(of_parts)
        return measured_order(*of_parts)

    monkeypatch.setattr(adaptive_film, "measured_order", noted)

    def filled(arrange: Callable[[list[tuple[PixelGroup, int, int]]], object]) -> AdaptiveFilm:
        film = AdaptiveFilm(WIDTH, HEIGHT)
        for work in groups:
            work = list(work)
            arrange(work)
            for group, first, last in work:
                add(film, samples, group, first, last)
            film.end_round()
        return film

    film = filled(list)
    assert 0.5 < film.order < 0.95
    for arrange in (list.reverse, random.Random(1).shuffle, random.Random(2).shuffle):
        other = filled(arrange)
        assert np.array_equal(film.linear, other.linear)
        assert np.array_equal(film.variance, other.variance)
        assert np.array_equal(film.samples, other.samples)
        assert (film.order, film.error) == (other.order, other.error)
    assert len(sums) == 4 * len(groups)
    assert sums == sums[: len(groups)] * 4
    assert film.samples.ravel()[pixels[[0, 800, 1000, 3000, 4500, 6000, 7999]]].tolist() == (
        [48] * 4 + [32, 24, 16]
    )


def test_a_preview_shows_and_leaves_no_trace() -> None:
    samples = normal(13, 24)
    film = AdaptiveFilm(WIDTH, HEIGHT)
    quick = np.random.default_rng(14).random((3, 6), np.float32)
    film.add(Tile(5, 3, 2, 3, 2), quick, 1.0, 1, False)
    assert np.array_equal(film.linear[:, 2:4, 3:6].reshape(3, -1), quick)
    assert not film.samples.any()
    assert film.error == 0
    add(film, samples, everything(), 0, 16)
    film.end_round()
    add(film, samples, everything(), 16, 24)
    plain = AdaptiveFilm(WIDTH, HEIGHT)
    add(plain, samples, everything(), 0, 16)
    plain.end_round()
    add(plain, samples, everything(), 16, 24)
    assert np.array_equal(film.linear, plain.linear)
    assert np.array_equal(film.variance, plain.variance)


def test_uniform_samples_in_closed_form() -> None:
    film = AdaptiveFilm(4, 1)
    assert film.uniform_samples == 0
    film.samples[0] = (16, 16, 64, 256)
    film.variance[0] = (0, 1, 4, 2)
    # Independent samples: one of each pixel has the variances 0, 16, 256 and 512; n of them the mean 7 / 4.
    assert film.error == pytest.approx(math.sqrt(7 / 4))
    assert film.uniform_samples == pytest.approx((0 + 16 + 256 + 512) / 7)
    film.order = 0.75
    unit = 16**1.5 + 4 * 64**1.5 + 2 * 256**1.5
    assert film.uniform_samples == pytest.approx((unit / 7) ** (1 / 1.5))
    film.samples[0] = 64
    assert film.uniform_samples == pytest.approx(64), "which is what every pixel has"
    film.variance[0] = 0
    assert film.uniform_samples == 64


@pytest.mark.parametrize("radiance", [1e-12, 1.0, 1e12])
def test_the_estimate_is_in_the_units_of_the_radiance(radiance: float) -> None:
    samples = normal(15, 48)
    expected = fill(samples, (16, 48)).error
    samples.values *= radiance
    assert fill(samples, (16, 48)).error == pytest.approx(radiance * expected, rel=1e-4)
