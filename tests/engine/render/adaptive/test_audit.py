"""The audit of a told error: by a second picture of some pixels, whose points are independent of the first.

An audit's own standard error is 6 to 10% of the variance for the noise here; where 20 of them are averaged, 6 standard
errors are the room they have, which chance exceeds less than once in 1e7.
"""

import math
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from course.engine.core.samplers import Block
from course.engine.core.tiles import Work
from course.engine.render.adaptive.audit import (
    DRIFT,
    EVENLY,
    FEWEST,
    PIXELS,
    QUIET,
    draw,
    judge,
    work_for,
)
from course.engine.render.adaptive.film import PARTS, AdaptiveFilm
from course.engine.render.adaptive.pixel_groups import PixelGroup, TwinGroup
from course.engine.terms.samplers.sobol import SobolSampler

Array = NDArray[Any]
WIDTH, HEIGHT, SAMPLES = 120, 100, 64
SHARE = 1 / 16
DEVIATION = np.geomspace(0.1, 1, WIDTH * HEIGHT)


def add(
    film: AdaptiveFilm, group: PixelGroup, rng: np.random.Generator, wrong: float = 1.0
) -> None:
    """Independent normal samples of every pixel's own deviation.

    The parts of a pixel differ so much that its variance is told to be ``wrong`` times what it is.
    """
    each = DEVIATION[group.pixels][:, None] * math.sqrt(PARTS / SAMPLES)
    parts = each * rng.standard_normal((3, group.size, PARTS))
    middle = parts.mean(axis=2, keepdims=True)
    mean = 0.5 + (middle + math.sqrt(wrong) * (parts - middle)).reshape(3, -1)
    mean = np.concatenate((mean, np.ones((1, mean.shape[1]))))
    film.add(group, mean.astype(np.float32), SAMPLES / PARTS, SAMPLES, True)


def noisy(seed: int, wrong: float = 1.0) -> AdaptiveFilm:
    film = AdaptiveFilm(WIDTH, HEIGHT, net=False)
    group = PixelGroup(0, np.arange(WIDTH * HEIGHT), WIDTH)
    add(film, group, np.random.default_rng(seed), wrong)
    film.end_round()
    return film


def audited(film: AdaptiveFilm, number: int, seed: int, wrong: float = 1.0) -> float:
    sample = draw(film, number, SHARE)
    assert sample is not None
    rng = np.random.default_rng((seed, number, 1))
    for work in work_for(sample, film, number, 1):
        assert isinstance(work.tile, TwinGroup)
        assert work.samples == SAMPLES
        add(film, work.tile, rng, wrong)
    judge(film, sample)
    return film.correction


@pytest.mark.parametrize("wrong", [0.25, 1.0, 4.0])
def test_a_told_variance_is_corrected(wrong: float) -> None:
    """Of a factor that is wrong nearly all is found; the rest is what a film is trusted."""
    found = []
    for seed in range(20):
        film = noisy(seed, wrong)
        true = float(((film.linear - 0.5) ** 2).mean())
        found.append(math.log(audited(film, 0, seed, wrong) * float(film.variance.mean()) / true))
    # Each has a standard error of about 8%; the film's opinion counts for DOUBT, of which 4% are left.
    trusted = 0.06 * abs(math.log(wrong))
    assert abs(float(np.mean(found))) < trusted + 6 * 0.09 / math.sqrt(20)


@pytest.mark.parametrize(("left", "unbelieved"), [(1 / 3, 0.06), (0.2, 0.01), (0.1, 0.01)])
def test_a_picture_that_is_better_than_its_second_one_is_told_so(
    left: float, unbelieved: float
) -> None:
    """As where light is rare: what was bright by chance was sampled on, and the second picture finds such light anew.

    Divided evenly, the sum of both squared errors would be 2, 3 and 5.5 times what the first picture has.
    """
    found = []
    for seed in range(20):
        film = noisy(seed)
        film.linear[:] = 0.5 + math.sqrt(left) * (film.linear - 0.5)
        film.variance *= np.float32(left)
        true = float(((film.linear - 0.5) ** 2).mean())
        found.append(math.log(audited(film, 0, seed) * float(film.variance.mean()) / true))
    # A difference by a factor 3 is believed to 93% of its logarithm, which leaves 6%; each scatters by 2%.
    assert abs(float(np.mean(found))) < unbelieved + 6 * 0.02 / math.sqrt(20)


def test_second_pictures_tell_their_variance_without_bias() -> None:
    """Over 12000 pixels of three channels the mean has a standard error of 1%, its room is 6 of them."""
    film = noisy(8)
    pixels = np.arange(WIDTH * HEIGHT)
    add(film, TwinGroup(1, pixels, WIDTH, len(pixels)), np.random.default_rng(9))
    _, variance = film.twins_apart(pixels)
    assert variance.mean() == pytest.approx((DEVIATION**2).mean() / SAMPLES, rel=0.06)


def test_an_audit_sees_what_was_left_since_it_looked_done() -> None:
    """Pixels that are told to have no variance at all are drawn too."""
    film = noisy(1)
    film.variance.reshape(-1)[::2] = 0
    true = float(((film.linear - 0.5) ** 2).mean())
    told = float(film.variance.mean())
    assert told < 0.6 * true
    corrections = [audited(noisy_like(film), 0, seed) for seed in range(20)]
    assert 0.7 < np.mean(corrections) * told / true < 1.3


def noisy_like(film: AdaptiveFilm) -> AdaptiveFilm:
    other = noisy(1)
    other.variance[:] = film.variance
    return other


@pytest.mark.parametrize("fallen", [1.0, math.e])
def test_a_later_audit_is_weighed_against_the_earlier_ones(fallen: float) -> None:
    """By their certainty; that of the earlier ones is the less, the more the told variance has fallen since."""
    logs = []
    for correction in (1.0, 2.0):
        film = noisy(3)
        film.correction, film.doubt = correction, 0.01
        film.judged = fallen * film.told
        logs.append(math.log(audited(film, 1, 3)))
    share = 1 - (logs[1] - logs[0]) / math.log(2)
    doubt = film.doubt / share
    assert 2 / (3 * PIXELS) < doubt < 0.01
    before = 0.01 + DRIFT**2 * math.log(fallen)
    assert share == pytest.approx(before / (before + doubt), rel=1e-6)
    assert film.judged == film.told


def test_pixels_are_drawn_by_their_variance_and_by_the_film_alone() -> None:
    film = noisy(4)
    sample, again = draw(film, 0, SHARE), draw(film, 0, SHARE)
    assert sample is not None
    assert again is not None
    assert np.array_equal(sample.pixels, again.pixels)
    assert sample.drawn.sum() == int(SHARE * WIDTH * HEIGHT)
    assert len(np.unique(sample.pixels)) == len(sample.pixels)
    noise = DEVIATION**2 / (DEVIATION**2).mean()
    best = np.sqrt(noise**2 + QUIET**2)
    chance = (1 - EVENLY) * best / best.mean() + EVENLY
    expected = float((noise * chance).mean())
    seen = float((noise[sample.pixels] * sample.drawn).sum() / sample.drawn.sum())
    assert seen == pytest.approx(expected, rel=0.2)
    most = draw(film, 0, 1.0)
    assert most is not None
    assert most.drawn.sum() == PIXELS
    other = draw(film, 1, SHARE)
    assert other is not None
    assert not np.array_equal(sample.pixels, other.pixels)


def test_an_audit_costs_no_more_than_its_share() -> None:
    film = noisy(5)
    film.samples[:50] = 8
    sample = draw(film, 0, SHARE)
    assert sample is not None
    spent = float((sample.samples * sample.drawn).sum())
    assert spent < 1.25 * SHARE * film.samples.sum()


def test_small_and_quiet_pictures_have_none() -> None:
    film = noisy(6)
    film.variance[:] = 0
    assert draw(film, 0, SHARE) is None
    small = AdaptiveFilm(8, 8)
    small.samples[:] = 8
    small.variance[:] = 1
    assert SHARE * small.samples.sum() < FEWEST * 8
    assert draw(small, 0, SHARE) is None


def test_work_covers_the_sample_once_by_other_points() -> None:
    film = noisy(7)
    film.samples[::3] = 128
    film.samples[1::3] = 4096
    sample = draw(film, 2, SHARE)
    assert sample is not None
    work: list[Work] = work_for(sample, film, 2, 10)
    pixels = np.concatenate([item.tile.pixels for item in work])  # type: ignore[union-attr]
    assert np.array_equal(np.sort(pixels), sample.pixels)
    assert len({item.tile.number for item in work}) == len(work)
    assert {item.samples for item in work} <= {SAMPLES, 128, 1024}


def test_second_points_are_others_than_the_first() -> None:
    pixels = np.arange(200)
    first, twin = PixelGroup(0, pixels, 20), TwinGroup(1, pixels, 20, 200)
    a, b = (
        SobolSampler(3).draw(Block(group.pixel_numbers(20), 0, 16, group.number), 0, 4)
        for group in (first, twin)
    )
    assert (a.reshape(4, 200, 16) != b.reshape(4, 200, 16)).any(axis=2).all()
    # Means over stratified points would correlate if the scrambles did: 800 pairs, 6 standard errors.
    x, y = (points.reshape(4, 200, 16).mean(axis=2).ravel() for points in (a, b))
    assert abs(np.corrcoef(x, y)[0, 1]) < 6 / math.sqrt(800)
    assert np.array_equal(first.corners(), twin.corners())
