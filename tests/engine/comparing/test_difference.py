"""The picture of a difference: colours by sign, and a legend below."""

import numpy as np
from numpy.typing import NDArray

from course.engine.comparing.difference import NARROWEST, difference_picture
from course.engine.formats.pictures.display import linear_to_srgb8


def colours(a: NDArray[np.float32], b: NDArray[np.float32]) -> NDArray[np.int64]:
    """(H', W', 3) codes of sRGB."""
    return linear_to_srgb8(difference_picture(a, b)).astype(np.int64)


def test_red_where_the_first_is_brighter_and_blue_where_the_second_is() -> None:
    a = np.full((40, 200, 3), 0.5, np.float32)
    b = a.copy()
    a[:20, :50] += 0.1
    b[20:40, 100:] += 0.1
    shown = colours(a, b)
    assert shown[10, 20].tolist() == [103, 0, 31]
    assert shown[30, 150].tolist() == [5, 48, 97]
    assert shown[10, 150].tolist() == [247, 247, 247]


def test_colours_follow_the_size_of_the_difference() -> None:
    a = np.zeros((50, 300, 3), np.float32)
    a += np.linspace(-1, 1, 300, dtype=np.float32)[:, None]
    shown = colours(a, np.zeros_like(a))[25]
    lightness = shown @ (0.299, 0.587, 0.114)
    assert (np.diff(lightness[:148]) >= 0).all()
    assert (np.diff(lightness[152:]) <= 0).all()


def test_the_legend_says_the_scale_and_is_as_wide_as_its_words() -> None:
    small = np.zeros((10, 12, 3), np.float32)
    one = colours(small + np.float32(0.25), small)
    assert one.shape[0] > 10
    assert one.shape[1] == NARROWEST
    left = (NARROWEST - 12) // 2
    assert (one[:10, left : left + 12] == [103, 0, 31]).all()
    assert (one[:10, :left] == 255).all()
    other = colours(small + np.float32(0.5), small)
    below = slice(10, None)
    assert not np.array_equal(one[below], other[below]), "the numbers are others"
    assert np.array_equal(one[:10], other[:10])


def test_equal_pictures_are_white() -> None:
    same = np.full((20, 200, 3), 0.5, np.float32)
    assert (colours(same, same)[:20] == 247).all()
