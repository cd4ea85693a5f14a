"""Tiles: they cover the picture once, and hold about one batch of rays."""

import numpy as np
import pytest

from course.engine.core.rays import RAYS
from course.engine.core.tiles import Tile, spread_over_cache, tile_picture
from course.engine.terms.work import halves, spread_pixels

PICTURES = [(1, 1), (7, 5), (64, 64), (640, 480), (33, 200), (1, 1000), (1000, 1)]


@pytest.mark.parametrize(("width", "height"), PICTURES)
@pytest.mark.parametrize("samples", [1, 3, 16, 64, 1024, 65536])
@pytest.mark.parametrize("batches", [1, 3, 16])
def test_tiles_cover_every_pixel_once(width: int, height: int, samples: int, batches: int) -> None:
    if width * height * samples > 2e8:
        width, height = min(width, 60), min(height, 50)
    count = np.zeros((height, width), int)
    tiles = tile_picture(width, height, samples, batches)
    assert len({tile.number for tile in tiles}) == len(tiles)
    for tile in tiles:
        assert tile.size > 0
        assert tile.x + tile.width <= width
        assert tile.y + tile.height <= height
        count[tile.rows, tile.columns] += 1
    assert (count == 1).all()


@pytest.mark.parametrize("samples", [1, 2, 3, 4, 7, 16, 100, 1000, 16384, 65536])
def test_a_tile_holds_at_most_one_batch_and_at_least_half_of_one(samples: int) -> None:
    tiles = tile_picture(512 if samples < 1000 else 64, 256 if samples < 1000 else 8, samples)
    largest = max(tile.size for tile in tiles)
    assert largest * samples <= max(RAYS, samples)
    assert largest * samples > min(RAYS / 2, samples / 2)


@pytest.mark.parametrize("batches", [1, 16])
@pytest.mark.parametrize("samples", [1, 2, 3, 4, 7, 16, 100, 256])
def test_the_rows_of_a_tiles_arrays_lie_in_different_places_of_the_cache(
    samples: int, batches: int
) -> None:
    """A first-level cache has room for eight numbers that are a multiple of 4096 bytes apart, and a loop has thirty."""
    side = 1600 if batches > 1 else 300
    tile = tile_picture(side, side, samples, batches)[0]
    starts = np.arange(24) * 4 * tile.size * samples % 4096 // 64
    assert np.bincount(starts).max() <= 6


@pytest.mark.parametrize("more", [True, False])
@pytest.mark.parametrize("samples", [1, 3, 16, 64, 512])
@pytest.mark.parametrize("pixels", [1, 100, 1024, 4096])
def test_numbers_of_pixels_that_spread_over_the_cache(
    pixels: int, samples: int, more: bool
) -> None:
    found = spread_pixels(pixels, samples, more)
    assert spread_over_cache(found * samples) or found == pixels
    between = range(min(found, pixels) + (not more), max(found, pixels) + (not more))
    assert not any(spread_over_cache(n * samples) for n in between)
    assert found >= pixels if more else 1 <= found <= pixels


def test_a_pixel_of_very_many_samples_is_left_as_it_is() -> None:
    assert spread_pixels(4, 16384) == spread_pixels(4, 16384, True) == 4


def test_every_tile_has_a_number_of_its_own_and_small_ones_come_last() -> None:
    tiles = tile_picture(100, 100, 16)
    assert sorted(tile.number for tile in tiles) == list(range(len(tiles)))
    sizes = [tile.size for tile in tiles]
    assert sizes == sorted(sizes, reverse=True)


@pytest.mark.parametrize(("width", "height"), [(2, 1), (1, 2), (7, 5), (5, 8), (1, 1000)])
def test_halves_make_the_whole(width: int, height: int) -> None:
    tile = Tile(3, 5, 2, width, height)
    count = np.zeros((height, width), int)
    for half in halves(tile):
        assert abs(half.size - tile.size / 2) <= min(width, height) / 2
        assert half.number == tile.number
        count[half.y - 2 : half.y - 2 + half.height, half.x - 5 : half.x - 5 + half.width] += 1
    assert (count == 1).all()


def test_pixels_are_numbered_row_by_row_and_corners_go_with_them() -> None:
    tile = Tile(3, 5, 2, 4, 3)
    numbers = tile.pixel_numbers(10)
    x, y = tile.corners()
    assert numbers.tolist() == [25, 26, 27, 28, 35, 36, 37, 38, 45, 46, 47, 48]
    assert numbers.dtype == np.uint32
    assert x.dtype == y.dtype == np.float32
    assert np.array_equal(y * 10 + x, numbers)


def test_the_last_pixel_of_the_largest_picture_has_its_number() -> None:
    tile = Tile(0, 65535, 65535, 1, 1)
    assert tile.pixel_numbers(65536).tolist() == [2**32 - 1]
