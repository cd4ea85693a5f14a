"""Groups of pixels from anywhere, and the order along Morton's curve that keeps neighbours together."""

import numpy as np
import pytest

from course.engine.render.adaptive.pixel_groups import PixelGroup, nearby_order

SIZES = [(1, 1), (1, 7), (9, 1), (2, 2), (5, 3), (40, 30), (33, 64), (257, 3), (65536, 1)]


def test_a_group_knows_the_corners_and_numbers_of_its_pixels() -> None:
    group = PixelGroup(3, np.array([0, 6, 7, 13, 20]), 7)
    assert group.size == 5
    x, y = group.corners()
    assert x.tolist() == [0, 6, 0, 6, 6]
    assert y.tolist() == [0, 0, 1, 1, 2]
    assert x.dtype == y.dtype == np.float32
    numbers = group.pixel_numbers(7)
    assert numbers.tolist() == [0, 6, 7, 13, 20]
    assert numbers.dtype == np.uint32


def test_the_corners_in_the_largest_picture_are_exact() -> None:
    group = PixelGroup(0, np.array([65535 * 65536 + 65535]), 65536)
    assert [axis.tolist() for axis in group.corners()] == [[65535], [65535]]
    assert group.pixel_numbers(65536).tolist() == [2**32 - 1]


@pytest.mark.parametrize(("width", "height"), SIZES)
def test_every_pixel_comes_once(width: int, height: int) -> None:
    order = nearby_order(width, height)
    assert np.array_equal(np.sort(order), np.arange(width * height))


@pytest.mark.parametrize(("width", "height"), [size for size in SIZES if size[0] < 1000])
def test_the_order_is_that_of_interleaved_digits(width: int, height: int) -> None:
    def place(pixel: int) -> int:
        y, x = divmod(pixel, width)
        digits = zip(f"{y:010b}", f"{x:010b}", strict=True)
        return int("".join(a + b for a, b in digits), 2)

    assert nearby_order(width, height).tolist() == sorted(range(width * height), key=place)


def test_one_row_or_column_stays_as_it_is() -> None:
    assert np.array_equal(nearby_order(65536, 1), np.arange(65536))
    assert np.array_equal(nearby_order(1, 65536), np.arange(65536))


@pytest.mark.parametrize("side", [2, 4, 16])
def test_a_stretch_of_four_to_the_k_pixels_is_a_square(side: int) -> None:
    y, x = np.divmod(nearby_order(64, 32).reshape(-1, side * side), 64)
    for axis in (x, y):
        assert (np.ptp(axis, axis=1) == side - 1).all()
