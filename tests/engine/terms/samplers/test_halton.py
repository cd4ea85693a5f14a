"""Samplers that call the modules `quasi_monte_carlo` and `sampling`: which numbers they draw, number by number.

Expected numbers are exact fractions and Marsaglia's three shifts in Python's integers; the modules' functions are not
asked. What a pixel is moved by is hidden in a hash, but Halton's point 0 is 0 in all coordinates: sample 0 shows it.
"""

from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from course.engine.core.samplers import Block, Sampler
from course.engine.functions.effects import Effects
from course.engine.terms.samplers import FUNCTIONS, make_sampler

PRIMES = (2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53, 59, 61, 67, 71)
PIXELS = 40
EFFECTS = Effects("solutions")


def sampler(name: str, seed: int = 5) -> Sampler:
    return make_sampler(name, seed, *(EFFECTS.function(*each) for each in FUNCTIONS[name]))


def block(samples: int, first: int = 0, pixels: int = PIXELS) -> Block:
    return Block(np.arange(100, 100 + pixels, dtype=np.uint32), first, samples, 3)


def inverse(base: int, i: int) -> Fraction:
    value, weight = Fraction(0), Fraction(1, base)
    while i:
        value += i % base * weight
        i, weight = i // base, weight / base
    return value


def apart(u: NDArray[Any], expected: NDArray[Any]) -> float:
    """The largest distance between numbers, around the circle that [0, 1) is when it is moved."""
    distance = np.abs(u - expected) % 1
    return float(np.minimum(distance, 1 - distance).max())


@pytest.mark.parametrize(("first", "samples"), [(0, 16), (16, 16), (992, 7)])
def test_halton_draws_its_points_moved_by_a_vector_of_the_pixel(first: int, samples: int) -> None:
    one = sampler("halton")
    for dimension, width in ((0, 2), (2, 2), (4, 1), (5, 3), (18, 2)):
        moved_by = one.draw(block(1), dimension, width).reshape(width, PIXELS, 1)
        u = one.draw(block(samples, first), dimension, width).reshape(width, PIXELS, samples)
        points = [
            [float(inverse(base, i)) for i in range(first, first + samples)]
            for base in PRIMES[dimension : dimension + width]
        ]
        # Two roundings to float32.
        assert apart(u, np.array(points)[:, None] + moved_by.astype(np.float64)) < 2**-22
        assert len(np.unique(moved_by)) == width * PIXELS


@pytest.mark.parametrize("samples", [1, 6, 16])
def test_hammersley_draws_its_points_moved_by_a_vector_of_the_pixel(samples: int) -> None:
    one = sampler("hammersley")
    for dimension, width in ((0, 2), (2, 3), (5, 1), (18, 2)):
        u = one.draw(block(samples), dimension, width).reshape(width, PIXELS, samples)
        for row in range(width):
            d = dimension + row
            points = [
                float(inverse(PRIMES[d - 1], i) if d else Fraction(i, samples))
                for i in range(samples)
            ]
            moved_by = u[row, :, :1].astype(np.float64)
            assert apart(u[row], np.array(points) + moved_by) < 2**-22
            assert len(np.unique(moved_by)) == PIXELS


@pytest.mark.parametrize("dimension", [0, 2, 7, 300])
def test_chained_draws_the_whole_pattern_in_an_order_and_moved(dimension: int) -> None:
    samples = 12
    u = sampler("chained").draw(block(samples), dimension, 2).reshape(2, PIXELS, samples)
    pattern = np.array([[i / samples, float(inverse(2, i))] for i in range(samples)])
    orders = set()
    for x, y in np.moveaxis(u.astype(np.float64), 1, 0):
        # Moved back by one of its own points, the set is a set of differences of the pattern.
        order = np.argsort((x - x.min() + 0.5 / samples) % 1)
        found = next(
            turn
            for turn in range(samples)
            if apart((y[order] - y[order[0]]), np.roll(pattern[:, 1], -turn) - pattern[turn, 1])
            < 2**-21
        )
        assert apart(x[order] - x[order[0]], np.arange(samples) / samples) < 2**-21
        orders.add((*order.tolist(), found))
    assert len(orders) > PIXELS // 2, "the pixels take their samples in the same order"


def test_chained_pairs_effects_at_random_within_each_pixel() -> None:
    one = sampler("chained")
    first = [one.draw(block(64), d, 1).reshape(PIXELS, 64) for d in (0, 2, 4)]
    ranks = [np.argsort(np.argsort(u, axis=1), axis=1) for u in first]
    for a, b in ((0, 1), (1, 2), (0, 2)):
        r = [np.corrcoef(x, y)[0, 1] for x, y in zip(ranks[a], ranks[b], strict=True)]
        # Each of standard deviation 1/8; 40 of them have a mean of their squares of 1/63 +- 1/280. Locked pairs have 1.
        assert np.mean(np.square(r)) < 1 / 63 + 6 / 280


def shifted(state: int) -> int:
    state ^= state << 13 & 0xFFFFFFFF
    state ^= state >> 17
    return state ^ (state << 5 & 0xFFFFFFFF)


def test_xorshift_draws_the_numbers_of_one_stream_a_pixel_and_dimension() -> None:
    states: list[NDArray[np.uint32]] = []

    def noted(state: NDArray[np.uint32]) -> Any:
        states.append(state.copy())
        return EFFECTS.function("sampling", "xorshift32")(state)

    u = make_sampler("xorshift", 5, noted).draw(block(9), 2, 3).reshape(3, PIXELS, 9)
    stream = states[0].reshape(3, PIXELS)
    assert len(states) == 9
    assert len(np.unique(stream)) == 3 * PIXELS, "streams begin alike"
    for row in range(3):
        for pixel in range(PIXELS):
            state = int(stream[row, pixel])
            for sample in range(9):
                state = shifted(state)
                assert u[row, pixel, sample] == (state >> 8) / 2**24


def test_xorshift_never_starts_at_0(monkeypatch: pytest.MonkeyPatch) -> None:
    def all_zero(keys: NDArray[np.uint32], *salts: int) -> NDArray[np.uint32]:
        return np.zeros((len(salts), len(keys)), np.uint32)

    monkeypatch.setattr("course.engine.terms.samplers.xorshift.hash_words", all_zero)
    u = sampler("xorshift").draw(block(8), 0, 2)
    assert (u.reshape(2, PIXELS, 8)[:, :, 1:].std(axis=2) > 0).all()


def test_xorshift_goes_on_with_other_numbers() -> None:
    one = sampler("xorshift")
    a, b = (one.draw(block(16, first), 2, 1).reshape(PIXELS, 16) for first in (0, 16))
    assert not np.isin(a, b).any()


@pytest.mark.parametrize("name", ["halton", "hammersley", "chained", "xorshift"])
def test_a_pixel_has_its_numbers_in_any_block(name: str) -> None:
    one = sampler(name)
    for dimension, width in ((0, 2), (6, 3)):
        whole = one.draw(block(12), dimension, width).reshape(width, PIXELS, 12)
        some = np.array([7, 3, 39, 20])
        there = Block((100 + some).astype(np.uint32), 0, 12, 77)
        again = sampler(name).draw(there, dimension, width).reshape(width, 4, 12)
        assert np.array_equal(again, whole[:, some])


@pytest.mark.parametrize("name", ["halton", "hammersley", "chained", "xorshift"])
def test_all_pixels_differ(name: str) -> None:
    u = sampler(name).draw(block(16, pixels=4096), 0, 2).reshape(2, 4096, 16)
    # 2^24 numbers: two of 4096 pixels begin alike in both dimensions once in 3e7 times.
    assert len(np.unique(u[:, :, 0], axis=1).T) == 4096


@pytest.mark.parametrize("word", [0, 1, 255, 256, 0x80000000, 0xFFFFFF7F, 0xFFFFFFFF])
def test_moved_points_stay_below_1(monkeypatch: pytest.MonkeyPatch, word: int) -> None:
    def same(keys: NDArray[np.uint32], *salts: int) -> NDArray[np.uint32]:
        return np.full((len(salts), len(keys)), word, np.uint32)

    def highest(i: NDArray[Any], dims: int) -> NDArray[np.float32]:
        return np.full((dims, len(i)), 1 - 2**-24, np.float32)

    monkeypatch.setattr("course.engine.terms.samplers.halton.hash_words", same)
    u = make_sampler("halton", 0, highest).draw(block(4), 0, 2)
    assert u.min() >= 0
    assert u.max() < 1
    assert apart(u, np.array(1 - 2**-24 + word / 2**32)) <= 2**-22


def test_each_chained_effect_has_a_generator_of_its_own() -> None:
    first = []

    def noted(patterns: list[Any], _: NDArray[Any], rng: np.random.Generator) -> Any:
        first.append(rng.random())
        return patterns

    for seed in (0, 1):
        one = make_sampler(
            "chained", seed, EFFECTS.function("quasi_monte_carlo", "hammersley"), noted
        )
        for dimension in (0, 2, 4):
            one.draw(block(8), dimension, 2)
            one.draw(block(8, pixels=3), dimension, 2)
    assert len(first) == len(set(first)) == 6
