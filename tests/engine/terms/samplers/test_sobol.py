"""The (0, 2)-sequence and its shuffled orders."""

from itertools import product

import numpy as np
import pytest
from scipy.stats import qmc

from course.engine.core.samplers import Block
from course.engine.core.types import Words
from course.engine.terms.samplers import sobol
from course.engine.terms.samplers.hashing import hash_words
from course.engine.terms.samplers.sobol import (
    KEPT,
    TO_UNIT,
    SobolSampler,
    net_indices,
    owen_scrambled,
    reversed_bits,
    shuffled,
    sobol_words,
)
from tests.lengths import fewer


def indices(first: int, count: int) -> Words:
    return np.arange(first, first + count, dtype=np.uint32)


@pytest.mark.parametrize("m", range(11))
def test_every_block_has_one_point_in_every_dyadic_rectangle(m: int) -> None:
    n = 2**m
    for block in (0, 1, 2, 3, 5, 8, 2 ** (16 - m) - 1):
        x, y = sobol_words(indices(block * n, n)).astype(np.uint64)
        for a in range(m + 1):
            cell = (x << np.uint64(a)) >> np.uint64(32) << np.uint64(m - a)
            cell += (y << np.uint64(m - a)) >> np.uint64(32)
            assert np.array_equal(np.sort(cell), np.arange(n)), (block, a)


def test_the_sequence_is_scipys() -> None:
    n = 1024
    index = indices(0, n)
    # SciPy walks the sequence in the order of the Gray code, one bit a step.
    theirs = qmc.Sobol(2, scramble=False, bits=32).random(n).T
    assert np.array_equal(sobol_words(index ^ (index >> np.uint32(1))) / 2.0**32, theirs)


def test_points_have_the_shape_of_their_indices() -> None:
    index = indices(0, 12)
    assert np.array_equal(sobol_words(index.reshape(3, 4)).reshape(2, 12), sobol_words(index))
    assert sobol_words(indices(5, 0)).shape == (2, 0)


@pytest.mark.parametrize("m", range(1, 9))
def test_a_shuffled_order_permutes_every_block_within_a_block(m: int) -> None:
    n = 2**m
    for block in (0, 1, 3, 6):
        for order in shuffled(indices(block * n, n), indices(0, 16)):
            start = order.min()
            assert start % n == 0
            assert np.array_equal(np.sort(order), indices(int(start), n))
            # Nor does it leave the block's own power of two: the first 2^k points stay the first 2^k.
            assert start == 0 if block == 0 else start < 2 ** (block * n).bit_length()


def test_an_index_has_its_place_whatever_else_is_asked_for() -> None:
    whole = shuffled(indices(0, 300), indices(0, 8))
    assert np.array_equal(shuffled(indices(100, 50), indices(0, 8)), whole[:, 100:150])


def test_orders_differ() -> None:
    orders = shuffled(indices(0, 64), indices(0, 256))
    assert len({tuple(order.tolist()) for order in orders}) == 256


def test_shuffling_makes_every_place_equally_likely() -> None:
    # Index 11 of 16 keeps its highest bit and lands on each of 8..15 with probability 1/8: over 8192 orders the
    # statistic has 7 degrees of freedom and is over 50 with a probability of 1.4e-8.
    landed = shuffled(indices(11, 1), indices(0, 8192))[:, 0]
    counts = np.bincount(landed, minlength=16)[8:]
    assert counts.sum() == 8192
    assert (((counts - 1024) ** 2) / 1024).sum() < 50


def test_reversing_bits_twice_changes_nothing() -> None:
    words = np.array([0, 1, 2, 0x80000000, 0x12345678, 0xFFFFFFFF], np.uint32)
    assert np.array_equal(reversed_bits(reversed_bits(words)), words)
    assert reversed_bits(words)[:3].tolist() == [0, 0x80000000, 0x40000000]


@pytest.mark.parametrize("m", range(1, 9))
def test_scrambled_points_are_still_one_to_a_rectangle(m: int) -> None:
    n = 2**m
    seeds = np.array([[3], [0x9E3779B9]], np.uint32)
    for block in (0, 1, 5):
        x, y = owen_scrambled(sobol_words(indices(block * n, n)), seeds).astype(np.uint64)
        for a in range(m + 1):
            cell = (x << np.uint64(a)) >> np.uint64(32) << np.uint64(m - a)
            cell += (y << np.uint64(m - a)) >> np.uint64(32)
            assert np.array_equal(np.sort(cell), np.arange(n)), (block, a)


def test_a_scramble_keeps_common_prefixes_common() -> None:
    rng = np.random.default_rng(1)
    words = rng.integers(0, 2**32, 256, np.uint32)
    for digits in (1, 5, 12, 24):
        other = words ^ (rng.integers(0, 2**32, 256, np.uint32) >> np.uint32(digits))
        a, b = (owen_scrambled(w, np.array([77], np.uint32)) for w in (words, other))
        assert np.array_equal(a >> np.uint32(32 - digits), b >> np.uint32(32 - digits))


def test_scrambling_halves_the_error_of_plain_points_on_a_peak_in_the_middle() -> None:
    # A peak at the centre of the square, where the plain points are symmetric. Over 512 scrambles the standard
    # deviation is known to 3%; the ratio is 0.42.
    def means(words: Words) -> float:
        x, y = words / 2.0**32 * 6 - 3
        return float((36 * 0.16 / (x * x + y * y + 0.16) ** 2).mean(axis=-1).std())

    rng = np.random.default_rng(2)
    words = sobol_words(indices(0, 256))[:, None, :]
    shift = rng.integers(0, 2**32, (2, 512, 1), np.uint32)
    seeds = rng.integers(0, 2**32, (2, 512, 1), np.uint32)
    assert means(owen_scrambled(words, seeds) ^ shift) < 0.55 * means(words ^ shift)


@pytest.mark.parametrize("m", range(1, 15))
def test_net_indices_permute_every_block(m: int) -> None:
    n = 2**m
    for block in (0, 1, 2, 5):
        order = np.sort(net_indices(indices(block * n, n)))
        assert order[0] % n == 0
        assert np.array_equal(order, indices(int(order[0]), n))


@pytest.mark.parametrize(("m", "t"), [(1, 0), (2, 1), (4, 1), (6, 1), (8, 3), (9, 2), (10, 3)])
def test_the_first_four_dimensions_are_a_net(m: int, t: int) -> None:
    index = shuffled(indices(0, 2**m), indices(0, 1))[0]
    words = np.concatenate([sobol_words(index), sobol_words(net_indices(index))]).astype(np.uint64)
    for digits in product(range(m - t + 1), repeat=4):
        if sum(digits) == m - t:
            box = np.zeros(2**m, np.uint64)
            for row, count in zip(words, digits, strict=True):
                box = (box << np.uint64(count)) + (row >> np.uint64(32 - count))
            assert (np.bincount(box.astype(np.int64), minlength=2 ** (m - t)) == 2**t).all(), digits


@fewer
@pytest.mark.parametrize("pixels", [[7], list(range(300))])
@pytest.mark.parametrize(
    ("first", "samples"), [(0, 4), (4, 12), (200, 100), (1000, 24), (1000, 25), (5000, 16)]
)
def test_points_that_are_kept_are_those_that_are_drawn(
    first: int, samples: int, pixels: list[int], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sobol, "_FIRST", sobol._FirstPoints())
    sampler = SobolSampler(3)
    block = Block(np.array(pixels, np.uint32), first, samples, 0)
    # Kept points before and after: few pixels have points of their own until then.
    for _ in range(2):
        points, start, salts = sampler.tables(block, 3)
        for pair in range(3):
            line = 2 * pair if pair < 2 else 0
            order, *scramble = hash_words(block.pixels, *salts[pair].tolist())
            order %= points.shape[1]
            words = points[line : line + 2, order, start : start + samples]
            words = words ^ np.stack(scramble)[:, :, None]
            drawn = sampler.draw(block, 2 * pair, 2).reshape(words.shape)
            assert np.array_equal((words >> 8) * TO_UNIT, drawn)
        sobol._FIRST.points(min(first + samples, KEPT))


def test_points_are_kept_for_as_long_as_they_are_worth(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sobol, "_FIRST", sobol._FirstPoints())
    few, many = (Block(np.arange(n, dtype=np.uint32), 64, 32, 0) for n in (2, 300))
    sampler = SobolSampler(0)
    sampler.tables(few, 4)
    assert not sobol._FIRST.has(1)
    sampler.tables(many, 4)
    assert sobol._FIRST.has(96)
    assert not sobol._FIRST.has(192)
