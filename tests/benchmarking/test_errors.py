"""Errors of pictures, against values that can be worked out by hand."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from course.base.errors import CourseError
from course.benchmarking.errors import dissimilarity, relative_mse, rmse

Measure = Callable[[Any, Any], float]
MEASURES = (rmse, relative_mse, dissimilarity)


def flat(value: float, height: int = 16, width: int = 24) -> NDArray[np.float64]:
    return np.full((height, width, 3), float(value))


def encoded(linear: float) -> float:
    """IEC 61966-2-1."""
    return 12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1 / 2.4) - 0.055


@pytest.mark.parametrize("measure", MEASURES)
def test_a_picture_has_no_error_against_itself(measure: Measure) -> None:
    picture = np.random.default_rng(1).random((16, 24, 3))
    assert measure(picture, picture) == pytest.approx(0, abs=1e-12)


def test_rmse_of_known_differences() -> None:
    reference = np.random.default_rng(2).random((16, 24, 3))
    image = reference.copy()
    image[::2] += 0.3
    image[1::2, :, 1] -= 0.6
    # Half of the values by 0.3, and a third of the other half by 0.6.
    assert rmse(image, reference) == pytest.approx((0.09 / 2 + 0.36 / 6) ** 0.5, rel=1e-12)


@settings(deadline=None)
@given(value=st.floats(0, 100), offset=st.floats(-10, 10))
def test_relative_mse_of_a_constant_offset(value: float, offset: float) -> None:
    expected = offset**2 / (value**2 + 0.01)
    found = relative_mse(flat(value) + offset, flat(value))
    # The offset loses digits in the sum.
    assert found == pytest.approx(
        expected, rel=1e-6, abs=1e-24 * (1 + value) ** 2 / (value**2 + 0.01)
    )


@settings(deadline=None)
@given(a=st.floats(0, 1), b=st.floats(0, 1))
def test_dissimilarity_of_two_flat_pictures(a: float, b: float) -> None:
    # Without variance SSIM is its luminance term alone, of the values that a screen shows.
    x, y = encoded(a), encoded(b)
    luminance = (2 * x * y + 1e-4) / (x * x + y * y + 1e-4)
    assert dissimilarity(flat(a), flat(b)) == pytest.approx(1 - luminance, abs=1e-9)


def test_dissimilarity_in_one_window() -> None:
    # A picture of the window's size holds it once: the formula of Wang et al. by hand, the mean over the channels.
    rng = np.random.default_rng(4)
    image, reference = rng.random((2, 11, 11, 3))
    line = np.exp(-0.5 * (np.arange(-5, 6) / 1.5) ** 2)
    weights = np.outer(line, line) / line.sum() ** 2
    expected = 0.0
    for channel in range(3):
        x, y = (np.vectorize(encoded)(picture[..., channel]) for picture in (image, reference))
        mean_x, mean_y = (weights * x).sum(), (weights * y).sum()
        variance_x, variance_y = (
            (weights * x * x).sum() - mean_x**2,
            (weights * y * y).sum() - mean_y**2,
        )
        covariance = (weights * x * y).sum() - mean_x * mean_y
        luminance = (2 * mean_x * mean_y + 1e-4) / (mean_x**2 + mean_y**2 + 1e-4)
        expected += luminance * (2 * covariance + 9e-4) / (variance_x + variance_y + 9e-4) / 3
    assert dissimilarity(image, reference) == pytest.approx(1 - expected, abs=1e-9)


def test_what_a_screen_shows_as_white_is_white() -> None:
    assert dissimilarity(flat(1), flat(50)) == pytest.approx(0, abs=1e-12)
    assert dissimilarity(flat(0), flat(-1)) == pytest.approx(0, abs=1e-12)


def test_the_negative_of_a_pattern_is_as_unlike_as_can_be() -> None:
    # Around the middle grey of the curve, a checker and its negative have a structure term of -1.
    checker = np.indices((16, 24)).sum(axis=0)[..., None] % 2 * np.ones(3)
    assert 1.99 < dissimilarity(checker, 1 - checker) <= 2


def test_float32_pictures_are_compared_in_float64() -> None:
    reference = np.full((16, 16, 3), 1, np.float32)
    image = reference.copy()
    image[0, 0, 0] = np.nextafter(np.float32(1), np.float32(2))
    assert rmse(image, reference) == pytest.approx(2.0**-23 / (16 * 16 * 3) ** 0.5, rel=1e-12)


@pytest.mark.parametrize("measure", MEASURES)
@pytest.mark.parametrize(
    ("image", "reference"),
    [
        (flat(0), flat(0, 17)),
        (flat(0)[..., :1], flat(0)),
        (flat(0)[..., 0], flat(0)[..., 0]),
        (flat(0)[:0], flat(0)[:0]),
    ],
)
def test_pictures_of_other_shapes_are_refused(
    measure: Measure, image: NDArray[np.float64], reference: NDArray[np.float64]
) -> None:
    with pytest.raises(CourseError, match=r"expected two \(H, W, 3\)"):
        measure(image, reference)


@pytest.mark.parametrize("measure", MEASURES)
@pytest.mark.parametrize("value", [np.nan, np.inf])
@pytest.mark.parametrize("swap", [False, True])
def test_pictures_that_are_not_finite_are_refused(
    measure: Measure, value: float, swap: bool
) -> None:
    bad = flat(0)
    bad[3, 4, 1] = value
    pair = (flat(0), bad) if swap else (bad, flat(0))
    with pytest.raises(CourseError, match="NaN or an infinity"):
        measure(*pair)


def test_a_picture_smaller_than_the_window_has_no_ssim() -> None:
    with pytest.raises(CourseError, match="at least 11 x 11 pixels, not 24 x 10"):
        dissimilarity(flat(0, 10), flat(0, 10))
    assert dissimilarity(flat(0.5, 11, 11), flat(0.5, 11, 11)) == pytest.approx(0, abs=1e-12)
