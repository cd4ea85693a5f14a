"""The compiled film of ``--error`` beside the one in NumPy: the same bits, for any samples."""

import numpy as np
import pytest

from course.engine.render.adaptive.film import PARTS, AdaptiveFilm
from course.engine.render.adaptive.pixel_groups import PixelGroup, TwinGroup

WIDTH, HEIGHT = 23, 17
PIXELS = WIDTH * HEIGHT
SHAPES = ((1, 1), (1, 5), (5, 1), (2, 2), (33, 40))
ARRAYS = ("linear", "samples", "variance", "cost", "_sums", "_halves", "_quarters")


def films(width: int = WIDTH, height: int = HEIGHT) -> tuple[AdaptiveFilm, AdaptiveFilm]:
    pytest.importorskip("numba")
    from course.engine.render.adaptive.compiled_film import CompiledFilm

    return AdaptiveFilm(width, height), CompiledFilm(width, height)


def same(one: AdaptiveFilm, other: AdaptiveFilm) -> None:
    for name in ARRAYS:
        np.testing.assert_array_equal(getattr(one, name), getattr(other, name), name)


@pytest.mark.parametrize("box", [True, False])
@pytest.mark.parametrize("scale", [1e-12, 1.0, 1e19])
def test_both_films_have_the_same_bits(box: bool, scale: float) -> None:
    rng = np.random.default_rng(7)
    pair, have = films(), np.zeros(PIXELS, np.int32)
    number = 0
    for ends in ((4,), (8,), (12, 16), (24, 32)):
        for end in ends:
            # Some pixels of each kind, in an order that isn't the picture's.
            chosen = rng.permutation(np.flatnonzero(have == have.max()))
            chosen = chosen[: len(chosen) // len(ends)] if end < ends[-1] else chosen
            n = len(chosen) * PARTS
            mean = rng.lognormal(0, 3, (4, n)) * np.array([[scale]] * 3 + [[1]])
            mean[:, rng.random(n) < 0.3] = 0
            weight = float(end) if box else rng.random(n).astype(np.float32)
            if not box:
                weight[::7] = 0
            for film in pair:
                film.add(
                    PixelGroup(number, chosen, WIDTH), mean.astype(np.float32), weight, end, True
                )
            have[chosen] = end
            number += 1
        same(*pair)
        (variance, cost), (variance_2, cost_2) = (film.end_round() for film in pair)
        np.testing.assert_array_equal(variance, variance_2)
        np.testing.assert_array_equal(cost, cost_2)
        assert pair[0].told == pair[1].told
        assert pair[0].order == pair[1].order


def test_previews_and_twins_have_the_same_bits() -> None:
    rng = np.random.default_rng(8)
    pair, pixels = films(), np.arange(PIXELS)
    colors = rng.random((3, PIXELS)).astype(np.float32)
    mean = rng.random((4, PIXELS * PARTS)).astype(np.float32)
    for film in pair:
        film.add(PixelGroup(0, pixels, WIDTH), colors, 1.0, 1, False)
    same(*pair)
    for film in pair:
        film.add(PixelGroup(0, pixels, WIDTH), mean, 1.0, 4, True)
        film.add(TwinGroup(1, pixels, WIDTH, PIXELS), mean[:, ::-1].copy(), 1.0, 4, True)
    same(*pair)
    for one, other in zip(*(film.twins_apart(pixels) for film in pair), strict=True):
        np.testing.assert_array_equal(one, other)


@pytest.mark.parametrize(("width", "height"), SHAPES)
def test_pictures_of_any_shape_are_smoothed_alike(width: int, height: int) -> None:
    rng = np.random.default_rng(9)
    pair = films(width, height)
    group = PixelGroup(0, np.arange(width * height), width)
    mean = rng.random((4, width * height * PARTS)).astype(np.float32)
    found = []
    for film in pair:
        film.add(group, mean, 1.0, 4, True)
        found.append(film.end_round())
    np.testing.assert_array_equal(*found)
