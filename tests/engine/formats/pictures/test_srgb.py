"""The sRGB curve, against the formula of IEC 61966-2-1 in float64."""

import numpy as np
import pytest
from numpy.typing import NDArray

from course.engine.formats.pictures import display
from course.engine.formats.pictures.display import linear_to_srgb8


def exact_code(x: NDArray[np.float64]) -> NDArray[np.float64]:
    """255 times the curve, not rounded."""
    return 255.0 * np.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055)


def grey(values: NDArray[np.float32]) -> NDArray[np.float32]:
    """A picture of one row."""
    return np.broadcast_to(values, (3, 1, values.size))


def test_codes_are_the_nearest_to_the_exact_curve() -> None:
    linear = np.concatenate(
        [np.linspace(0, 1, 50_001), np.geomspace(1e-8, 1, 50_001), np.linspace(0.003, 0.0033, 999)]
    ).astype(np.float32)
    code = linear_to_srgb8(grey(linear))[0, :, 0].astype(np.float64)
    # Half a code, and float32's rounding where two codes are equally near.
    assert np.abs(code - exact_code(linear.astype(np.float64))).max() <= 0.5 + 1e-4


def test_every_code_is_reached_from_the_value_it_stands_for() -> None:
    code = np.arange(256)
    v = code / 255
    linear = np.where(v <= 0.04045, v / 12.92, ((v + 0.055) / 1.055) ** 2.4).astype(np.float32)
    np.testing.assert_array_equal(linear_to_srgb8(grey(linear))[0, :, 1], code)


def test_codes_rise_with_the_light() -> None:
    linear = np.geomspace(1e-6, 4, 20_000).astype(np.float32)
    code = linear_to_srgb8(grey(linear))[0, :, 2].astype(int)
    assert (np.diff(code) >= 0).all()


def test_what_is_brighter_than_white_is_white() -> None:
    linear = np.array([1.0, 1.0001, 2.0, 1e30, np.finfo(np.float32).max], np.float32)
    assert (linear_to_srgb8(grey(linear)) == 255).all()


@pytest.mark.parametrize("white", [1e-30, 1e30])
@pytest.mark.parametrize("encoding", ["srgb", "linear"])
def test_a_white_at_its_ends_has_codes(white: float, encoding: str) -> None:
    linear = grey(np.array([0, 1e-25, 1, 1e25], np.float32))
    expected = [0, 255, 255, 255] if white < 1 else [0, 0, 0, 0]
    assert display.Display(white, encoding).codes(linear)[0, :, 0].tolist() == expected


def test_black_is_black() -> None:
    assert (linear_to_srgb8(grey(np.array([0.0, -0.0, 1e-30], np.float32))) == 0).all()


def test_channels_and_rows_keep_their_places() -> None:
    linear = np.zeros((3, 2, 4), np.float32)
    linear[0, 1, 3] = linear[1, 0, 2] = linear[2, 1, 0] = 1.0
    expected = np.zeros((2, 4, 3), np.uint8)
    expected[1, 3, 0] = expected[0, 2, 1] = expected[1, 0, 2] = 255
    np.testing.assert_array_equal(linear_to_srgb8(linear), expected)


@pytest.mark.parametrize("values", [1, 7, 3 * 5 * 2, 10_000])
def test_blocks_leave_no_seam(values: int, monkeypatch: pytest.MonkeyPatch) -> None:
    linear = np.random.default_rng(1).random((3, 11, 5), np.float32)
    whole = linear_to_srgb8(linear)
    monkeypatch.setattr(display, "BLOCK_VALUES", values)
    np.testing.assert_array_equal(linear_to_srgb8(linear), whole)


def test_a_picture_may_lie_in_memory_in_any_order() -> None:
    linear = np.random.default_rng(2).random((6, 4, 3), np.float32)
    across = np.moveaxis(linear, -1, 0)
    np.testing.assert_array_equal(
        linear_to_srgb8(across), linear_to_srgb8(np.ascontiguousarray(across))
    )
