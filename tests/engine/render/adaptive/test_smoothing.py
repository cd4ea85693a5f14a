"""Variances that learn from neighbours: closed forms of the weights, and what an edge lets through."""

import math

import numpy as np
import pytest

from course.engine.core.types import Floats32, Numbers
from course.engine.render.adaptive.allocation import LADDER
from course.engine.render.adaptive.smoothing import BLIND, LEAK, NOISE, Guide, smoothed

BINOMIAL = np.outer((1, 2, 1), (1, 2, 1))


def even_guide(shape: tuple[int, int]) -> Guide:
    """A guide of a picture of one colour."""
    return Guide(np.ones((3, *shape), np.float32), np.ones(shape, np.float32))


def samples_of(shape: tuple[int, int]) -> Numbers:
    return LADDER.take(np.random.default_rng(10).integers(0, 9, shape))


@pytest.mark.parametrize(
    ("samples", "share"), [(4, 1), (BLIND, 1), (2 * BLIND, 0.5), (1024, 1 / 32)]
)
def test_smoothing_spreads_a_variance_over_its_neighbours(samples: int, share: float) -> None:
    """All of it where samples are few, and less and less where there are enough to believe."""
    variance = np.zeros((5, 6), np.float32)
    variance[2, 2] = 16
    found = smoothed(variance, np.full((5, 6), samples, np.int32), 0.6, even_guide((5, 6)))
    expected = np.zeros((5, 6))
    expected[1:4, 1:4] = share * BINOMIAL
    expected[2, 2] += 16 * (1 - share)
    assert np.allclose(found, expected, rtol=1e-6)


@pytest.mark.parametrize("shape", [(1, 1), (1, 9), (7, 1), (6, 5)])
@pytest.mark.parametrize("order", [0.5, 0.65, 0.75])
def test_smoothing_keeps_what_is_even(shape: tuple[int, int], order: float) -> None:
    """Pixels that are equally noisy stay so, whatever their samples and colours."""
    samples = samples_of(shape)
    even = (3 * samples.astype(float) ** (-2 * order)).astype(np.float32)
    colours = np.random.default_rng(11).random((3, *shape), np.float32)
    for guide in (even_guide(shape), Guide(colours, even)):
        assert np.allclose(smoothed(even, samples, order, guide), even, rtol=1e-5)


def test_neighbours_count_as_if_they_had_as_many_samples() -> None:
    variance = np.array([[0, 1, 0]], np.float32)
    samples = np.array([[16, 64, 256]], np.int32)
    guide = even_guide((1, 3))
    # One sample has a variance of 64. Of the first pixel's weights, 4 and 2, a third is the middle one's; of the
    # middle one's, a half with 64 samples; of the last one's a third, and an eighth of that with 256 samples.
    expected = [64 / 3 / 16, 0.75, 64 / 3 / 8 / 256]
    assert smoothed(variance, samples, 0.5, guide)[0] == pytest.approx(expected)
    first = float(smoothed(variance, samples, 0.75, guide)[0, 0])
    assert math.isclose(first, 64**1.5 / 3 / 16**1.5, rel_tol=1e-6)


@pytest.mark.parametrize("axis", [0, 1])
def test_an_edge_lets_only_the_leak_through(axis: int) -> None:
    """Both sides of an edge have one colour each: a variance on one side reaches the other by the leak alone."""
    colours = np.zeros((3, 6, 6), np.float32)
    colours[:, 3:] = 1
    variance = np.full((6, 6), 1e-8, np.float32)
    values = np.zeros((6, 6), np.float32)
    values[2, 2] = 1
    if axis:
        colours, values = colours.swapaxes(1, 2), values.T
    found = Guide(np.ascontiguousarray(colours), variance).mean(np.ascontiguousarray(values))
    if axis:
        found = found.T
    total = 12 + 4 * LEAK
    assert found[1, 1:4] == pytest.approx(BINOMIAL[0] / 16)
    assert found[2, 1:4] == pytest.approx(BINOMIAL[1] / total)
    assert found[3, 1:4] == pytest.approx(LEAK * BINOMIAL[2] / total)
    assert not found[4:].any()


def test_colours_that_differ_by_noise_alone_count() -> None:
    """The weight of a neighbour falls as exp(-m / (4 (a + b))), m the mean squared difference of the colours."""
    colours = np.zeros((3, 1, 2), np.float32)
    colours[:, 0, 1] = (0.1, 0.2, 0.4)
    variance = np.array([[0.01, 0.03]], np.float32)
    # The binomial means of the variances: the edge pixel's own value is repeated.
    a, b = (3 * 0.01 + 0.03) / 4, (0.01 + 3 * 0.03) / 4
    weight = 2 * (LEAK + (1 - LEAK) * math.exp(-0.07 / (NOISE * (a + b))))
    found = Guide(colours, variance).mean(np.array([[0, 1]], np.float32))
    assert found[0] == pytest.approx([weight / (4 + weight), 4 / (4 + weight)], rel=1e-5)


@pytest.mark.parametrize("scale", [0, 1e-30, 1e18, 1e25])
def test_weights_are_finite_for_any_colours(scale: float) -> None:
    rng = np.random.default_rng(12)
    colours: Floats32 = (scale * rng.random((3, 5, 5))).astype(np.float32)
    for variance in (np.zeros((5, 5), np.float32), np.full((5, 5), 1e28, np.float32)):
        found = Guide(colours, variance).mean(np.ones((5, 5), np.float32))
        assert found == pytest.approx(np.ones((5, 5)))
