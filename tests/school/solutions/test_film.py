"""Film: the picture does not depend on the exposure, and black has no logarithm."""

import numpy as np
import pytest

from tests.school.solutions.contract import SOLUTIONS, frozen

expose = SOLUTIONS.function("film", "expose")
luminance = SOLUTIONS.function("film", "luminance")
photographic = SOLUTIONS.function("film", "photographic")
convert_gamut = SOLUTIONS.function("film", "convert_gamut")
quantize = SOLUTIONS.function("film", "quantize")

PICTURE = np.exp(np.random.default_rng(0).normal(0, 2, (3, 500)))
WIDE = np.array([(0.708, 0.292), (0.170, 0.797), (0.131, 0.046), (0.3127, 0.3290)]).T
SRGB = np.array([(0.64, 0.33), (0.30, 0.60), (0.15, 0.06), (0.3127, 0.3290)]).T


@pytest.mark.parametrize("stops", [-12, 3, 9])
def test_tone_mapping_undoes_an_exposure(stops: int) -> None:
    first = photographic(frozen(PICTURE), 0.18, 2, 0.8)
    assert photographic(expose(PICTURE, stops), 0.18, 2, 0.8) == pytest.approx(first, rel=1e-9)


@pytest.mark.parametrize("burn", [0, 1, 20])
def test_the_percentage_that_burns_is_at_white_or_beyond(burn: int) -> None:
    shown = luminance(photographic(PICTURE, 0.18, burn, 1))
    assert (shown >= 1 - 1e-9).mean() == pytest.approx(burn / 100, abs=1 / 500)


def test_a_picture_without_light_is_black() -> None:
    for size in (0, 1, 9):
        assert not photographic(np.zeros((3, size)), 0.18, 1, 1).any()


def test_a_gamut_and_back_is_the_same() -> None:
    there = convert_gamut(PICTURE, WIDE, SRGB)
    assert there.min() < 0
    assert convert_gamut(there, SRGB, WIDE) == pytest.approx(PICTURE, rel=1e-9, abs=1e-9)


def test_whole_codes_stay_whatever_the_numbers_are() -> None:
    codes = np.tile(np.arange(256), (3, 1))
    u = np.full(codes.shape, 1 - 2.0**-24, np.float32)
    assert (quantize((codes / 255).astype(np.float64), 0.5 * u) == codes).all()
    assert (quantize(np.ones((3, 4), np.float32), u[:, :4]) == 255).all()
