"""Samplers: numbers in [0, 1) that a path can rely on, wherever and in whichever order they are drawn."""

from math import isqrt

import numpy as np
import pytest

from course.engine.core.samplers import Block, Sampler
from course.engine.functions.effects import Effects
from course.engine.terms.samplers import FUNCTIONS, make_sampler
from tests.lengths import fewer

NAMES = tuple(FUNCTIONS)
EFFECTS = Effects("solutions")


def sampler(name: str, seed: int = 0) -> Sampler:
    functions = (EFFECTS.function(*function) for function in FUNCTIONS[name])
    return make_sampler(name, seed, *functions, size=(128, 128))


def block(pixels: int = 64, samples: int = 16, first: int = 0, part: int = 0) -> Block:
    return Block(np.arange(pixels, dtype=np.uint32), first, samples, part)


@fewer
@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize(("dimension", "width"), [(0, 2), (2, 2), (4, 1), (5, 3), (200, 2)])
def test_numbers_lie_in_the_half_open_unit_interval(name: str, dimension: int, width: int) -> None:
    for seed in range(4):
        u = sampler(name, seed).draw(block(512), dimension, width)
        assert u.shape == (width, 512 * 16)
        assert u.dtype == np.float32
        assert u.min() >= 0
        assert u.max() < 1


def test_the_largest_sobol_word_does_not_round_up_to_one() -> None:
    # 2^18 samples of one pixel come within 2^-18 of 1, and all 2^24 fractions are below 1 by construction.
    u = sampler("sobol").draw(block(1, 1 << 18), 0, 2)
    assert 1 - 2.0**-17 < u.max() < 1


@fewer
@pytest.mark.parametrize("name", [name for name in NAMES if name != "regular"])
@pytest.mark.parametrize("dimension", [0, 2, 3, 7, 100])
def test_numbers_are_uniform(name: str, dimension: int) -> None:
    # Halton's and Hammersley's points of one pixel are no independent numbers, and move together.
    samples = 1 if name in ("halton", "hammersley") else 16
    u = sampler(name, 1).draw(block(16384 // samples, samples), dimension, 2)
    for row in u:
        count = np.bincount((row * 32).astype(int), minlength=32)
        expected = row.size / 32
        chi_squared = ((count - expected) ** 2 / expected).sum()
        # 31 degrees of freedom; above 100 once in 10^8 even for independent numbers, and stratified ones
        # are more even.
        assert chi_squared < 100


@pytest.mark.parametrize("name", NAMES)
def test_drawing_is_repeatable_and_depends_on_the_seed(name: str) -> None:
    a, b = sampler(name, 3).draw(block(), 2, 2), sampler(name, 3).draw(block(), 2, 2)
    assert np.array_equal(a, b)
    if name != "regular":
        assert not np.array_equal(a, sampler(name, 4).draw(block(), 2, 2))


# Neighbours are to go against each other where the error is spread.
@pytest.mark.parametrize("name", sorted(set(NAMES) - {"regular", "blue_noise", "dithered"}))
def test_pixels_and_dimensions_are_uncorrelated(name: str) -> None:
    n = 4096
    one = sampler(name)
    u = np.concatenate([one.draw(block(n, 4), d, 2) for d in (0, 2, 4)]).reshape(6, n, 4)[..., 0]
    # sigma = 1 / sqrt(4096) = 0.0156; 6 sigma over some 40 checks: false-fail rate below 10^-7.
    correlation = np.corrcoef(u)
    np.fill_diagonal(correlation, 0)
    assert np.abs(correlation).max() < 0.094
    for row in u:
        for step in (1, 2, 64):
            assert abs(np.corrcoef(row[:-step], row[step:])[0, 1]) < 0.094


def test_sobol_pixels_keep_the_strata_of_the_sequence() -> None:
    u = sampler("sobol", 5).draw(block(100, 16), 6, 2).reshape(2, 100, 16)
    strata = np.sort((u * 16).astype(int), axis=2)
    assert (strata == np.arange(16)).all()


def test_sobol_extends_from_n_to_2n_without_losing_the_first_n() -> None:
    one = sampler("sobol", 2)
    for dimension in (0, 3, 62, 69):
        whole = one.draw(block(10, 32), dimension, 2).reshape(2, 10, 32)
        first = one.draw(block(10, 16), dimension, 2).reshape(2, 10, 16)
        second = one.draw(block(10, 16, first=16), dimension, 2).reshape(2, 10, 16)
        assert np.array_equal(np.concatenate((first, second), axis=2), whole)


def test_sobol_gives_a_pixel_its_numbers_in_any_block() -> None:
    one = sampler("sobol", 2)
    whole = one.draw(block(50), 4, 2).reshape(2, 50, 16)
    some = np.array([7, 3, 49, 20], np.uint32)
    there = one.draw(Block(some, 0, 16, 9), 4, 2).reshape(2, 4, 16)
    assert np.array_equal(there, whole[:, some])


def test_sobol_goes_on_deep_in_a_path_with_different_numbers() -> None:
    one = sampler("sobol")
    deep = [one.draw(block(1, 256), 64 + d, 1)[0] for d in range(4)]
    assert np.abs(np.corrcoef(deep) - np.eye(4)).max() < 6 / 16
    assert all(0.35 < row.mean() < 0.65 for row in deep)


@pytest.mark.parametrize("first", [0, 16])
def test_random_blocks_differ_from_part_to_part_and_from_stretch_to_stretch(first: int) -> None:
    one = sampler("random")
    a = one.draw(block(8, 16, first), 2, 2)
    assert not np.array_equal(a, one.draw(block(8, 16, first, part=1), 2, 2))
    assert not np.array_equal(a, one.draw(block(8, 16, first + 32), 2, 2))


@pytest.mark.parametrize("samples", [1, 2, 7, 16, 20])
def test_random_takes_any_number_of_samples(samples: int) -> None:
    for dimension in (0, 2):
        assert sampler("random").draw(block(5, samples), dimension, 2).shape == (2, 5 * samples)


@pytest.mark.parametrize("samples", [1, 4, 9, 25, 49, 144])
def test_jittered_has_one_point_in_each_stratum(samples: int) -> None:
    one, k = sampler("jittered", 1), isqrt(samples)
    for dimension in (0, 2, 6):
        x, y = np.minimum((one.draw(block(30, samples), dimension, 2) * k).astype(int), k - 1)
        cells = np.sort((k * y + x).reshape(30, samples), axis=1)
        # float32 may round a point on a border into the neighbouring cell.
        assert (cells == np.arange(samples)).mean() > 0.999
    for width in (1, 3):
        u = one.draw(block(30, samples), 4, width).reshape(width, 30, samples)
        strata = np.sort((u * samples).astype(int), axis=2)
        assert (strata == np.arange(samples)).mean() > 0.999


@pytest.mark.parametrize("samples", [1, 4, 16, 49])
def test_regular_has_the_centres_of_the_cells_the_same_in_every_pixel(samples: int) -> None:
    one, k = sampler("regular"), isqrt(samples)
    centre = (np.arange(k, dtype=np.float32) + np.float32(0.5)) / np.float32(k)
    for dimension in (0, 2, 8):
        u = one.draw(block(6, samples), dimension, 2).reshape(2, 6, samples)
        assert (u == u[:, :1]).all()
        points = sorted(zip(u[1, 0].tolist(), u[0, 0].tolist(), strict=True))
        expected = [(y, x) for y in centre.tolist() for x in centre.tolist()]
        assert np.allclose(points, expected, atol=1e-7)


@pytest.mark.parametrize("name", ["jittered", "regular"])
def test_later_dimensions_are_not_paired_in_the_order_of_the_pixels(name: str) -> None:
    # In the pixel's own order the light's corner would only ever be seen from the pixel's corner.
    one = sampler(name)
    pixel, light, other = (one.draw(block(1, 64), d, 2) for d in (0, 2, 4))
    for a, b in ((pixel, light), (light, other), (pixel, other)):
        # 64 shuffled pairs: sigma 1/8; 6 sigma would never fail a shuffle, and the same order has 1.
        assert abs(np.corrcoef(a[0], b[0])[0, 1]) < 0.75
        assert abs(np.corrcoef(a[1], b[1])[0, 1]) < 0.75


def test_extensible_is_what_can_be_continued() -> None:
    extensible = {name for name in NAMES if sampler(name).extensible}
    assert extensible == {"sobol", "random", "halton", "xorshift"}
