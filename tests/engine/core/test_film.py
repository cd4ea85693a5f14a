"""The film: weighted means of passes, whatever tile comes first."""

import numpy as np

from course.engine.core.film import Film
from course.engine.core.tiles import Tile, tile_picture

TILE = Tile(0, 1, 2, 3, 2)


def colours(seed: int, size: int = TILE.size) -> np.ndarray:
    return np.random.default_rng(seed).random((3, size), np.float32)


def test_a_pass_lands_in_its_tile_row_by_row() -> None:
    film = Film(6, 5)
    mean = colours(0)
    film.add(TILE, mean, 1.0, 4, True)
    assert film.linear.shape == (3, 5, 6)
    assert film.linear.dtype == np.float32
    assert np.array_equal(film.linear[:, 2:4, 1:4], mean.reshape(3, 2, 3))
    assert (film.samples[2:4, 1:4] == 4).all()
    outside = np.ones((5, 6), bool)
    outside[2:4, 1:4] = False
    assert not film.linear[:, outside].any()
    assert not film.samples[outside].any()


def test_passes_are_averaged_by_their_weights() -> None:
    film = Film(6, 5)
    passes = [colours(seed) for seed in range(3)]
    weights = [np.random.default_rng(9 + i).random(TILE.size, np.float32) for i in range(3)]
    for number, (mean, weight) in enumerate(zip(passes, weights, strict=True)):
        film.add(TILE, mean, weight, 16 * (number + 1), True)
    total = sum(mean.astype(float) * weight for mean, weight in zip(passes, weights, strict=True))
    expected = total / sum(weight.astype(float) for weight in weights)
    assert np.allclose(film.linear[:, 2:4, 1:4].reshape(3, -1), expected, rtol=1e-6)


def test_a_part_pass_shows_in_the_picture_but_not_in_the_sums() -> None:
    film, other = Film(6, 5), Film(6, 5)
    a, b, c = colours(1), colours(2), colours(3)
    film.add(TILE, a, 16.0, 16, True)
    film.add(TILE, b, 8.0, 24, False)
    shown = (a.astype(float) * 16 + b.astype(float) * 8) / 24
    assert np.allclose(film.linear[:, 2:4, 1:4].reshape(3, -1), shown, rtol=1e-6)
    film.add(TILE, c, 16.0, 32, True)
    other.add(TILE, a, 16.0, 16, True)
    other.add(TILE, c, 16.0, 32, True)
    assert np.array_equal(film.linear, other.linear)
    assert np.array_equal(film.samples, other.samples)


def test_a_continued_film_goes_on_bit_for_bit_and_leaves_the_old_one_alone() -> None:
    whole, part = Film(6, 5), Film(6, 5)
    passes = [colours(seed) for seed in range(4)]
    for number, mean in enumerate(passes):
        whole.add(TILE, mean, 16.0, 16 * (number + 1), True)
    for number, mean in enumerate(passes[:2]):
        part.add(TILE, mean, 16.0, 16 * (number + 1), True)
    before = part.linear.copy()
    more = part.continued(32)
    assert (more.samples == 32).all()
    for number, mean in enumerate(passes[2:], start=2):
        more.add(TILE, mean, 16.0, 16 * (number + 1), True)
    assert np.array_equal(more.linear, whole.linear)
    assert np.array_equal(part.linear, before)


def test_pixels_whose_weights_vanish_show_their_mean_and_yield_to_any_weight() -> None:
    film = Film(6, 5)
    a, b = colours(1), colours(2)
    film.add(TILE, a, np.zeros(TILE.size, np.float32), 16, True)
    assert np.allclose(film.linear[:, 2:4, 1:4].reshape(3, -1), a, rtol=1e-6)
    film.add(TILE, b, np.full(TILE.size, 1e-30, np.float32), 32, True)
    assert np.array_equal(film.linear[:, 2:4, 1:4].reshape(3, -1), b)


def test_many_equal_passes_keep_their_value() -> None:
    # Sums in float32 would have lost 0.1 by then; 4096 float64 additions err by less than 1e-12.
    film = Film(6, 5)
    mean = np.full((3, TILE.size), 0.1, np.float32)
    for number in range(4096):
        film.add(TILE, mean, 16.0, number + 1, True)
    assert np.array_equal(film.linear[:, 2:4, 1:4].reshape(3, -1), mean)


def test_the_order_of_tiles_does_not_matter() -> None:
    tiles = tile_picture(50, 40, 256)
    assert len(tiles) > 5
    a, b = Film(50, 40), Film(50, 40)
    for film, order in ((a, tiles), (b, tiles[::-1])):
        for tile in order:
            film.add(tile, colours(tile.number, tile.size), 1.0, 1, True)
    assert np.array_equal(a.linear, b.linear)
