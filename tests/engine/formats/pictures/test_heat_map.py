"""Heat maps: which colours numbers get."""

import numpy as np
import pytest
from numpy.typing import NDArray

from course.engine.formats.pictures.display import heat_map


def lightness(linear: NDArray[np.float32]) -> NDArray[np.float64]:
    """CIE L*, 0 to 100, of colours (3, ...)."""
    y = np.tensordot([0.2126, 0.7152, 0.0722], linear.astype(float), 1)
    return np.where(y > (6 / 29) ** 3, 116 * np.cbrt(y) - 16, (29 / 3) ** 3 * y)


def test_the_least_is_black_and_the_most_nearly_white() -> None:
    colours = heat_map(np.array([[16, 300, 65536]]))
    assert colours.shape == (3, 1, 3)
    assert colours.dtype == np.float32
    assert not colours[:, 0, 0].any()
    assert lightness(colours)[0, 2] > 98
    assert colours.min() >= 0
    assert colours.max() <= 1


def test_more_is_lighter_by_steps_of_much_the_same_size() -> None:
    values = np.geomspace(16, 65536, 25).reshape(5, 5)
    steps = np.diff(lightness(heat_map(values)).ravel())
    assert steps.min() > 100 / 24 / 3
    assert steps.max() < 100 / 24 * 1.5


def test_equal_ratios_are_equal_steps() -> None:
    values = np.array([[1.0, 2, 4, 8, 16, 32, 64]])
    assert np.allclose(heat_map(values), heat_map(1000 * values), atol=1e-6)
    # The same place between least and most is the same colour, whatever these are.
    assert np.allclose(heat_map(values)[..., 3], heat_map(values**2)[..., 3], atol=1e-6)
    assert np.allclose(heat_map(values)[..., 3:4], heat_map(values[:, ::3])[..., 1:2], atol=1e-6)


def test_a_pixel_keeps_its_place() -> None:
    values = np.array([[1.0, 4], [16, 2], [8, 1]])
    found = lightness(heat_map(values))
    assert found.shape == values.shape
    assert np.array_equal(np.argsort(found, axis=None), np.argsort(values, axis=None))


@pytest.mark.parametrize("value", [1, 16.0, 1e300, 1e-300])
def test_where_all_are_the_same_everything_is_black(value: float) -> None:
    assert not heat_map(np.full((2, 3), value)).any()


def test_any_range_of_numbers_has_colours() -> None:
    colours = heat_map(np.array([[1e-300, 1, 1e300]]))
    assert np.isfinite(colours).all()
    assert (np.diff(lightness(colours)) > 0).all()
