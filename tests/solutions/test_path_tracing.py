"""Path tracing: cosine-distributed bounces, what they leave of the light, and Russian roulette without bias."""

from __future__ import annotations

import math

import numpy as np
import pytest

from course.grading.checks.laws import DTYPES
from tests.solutions.contract import (
    SOLUTIONS,
    assert_mean,
    assert_uniform,
    assert_unit,
    directions,
    every_pair,
    frozen,
    unit,
    worst_directions,
    worst_units,
)

MODULE = "path_tracing"
diffuse_bounce = SOLUTIONS.function(MODULE, "diffuse_bounce")
throughput = SOLUTIONS.function(MODULE, "throughput")
russian_roulette = SOLUTIONS.function(MODULE, "russian_roulette")

N = 100_000

dtypes = pytest.mark.parametrize("dtype", DTYPES)


# ---------------------------------------------------------------- diffuse_bounce


@dtypes
def test_bounces_are_unit_and_above_every_normal(dtype: type) -> None:
    u = np.concatenate((worst_units(2, dtype), unit(2, 60, dtype, seed=1)), axis=1)
    normal, u = every_pair(worst_directions(dtype), u)
    found = diffuse_bounce(frozen(normal), frozen(u))
    assert_unit(found, 1e-5 if dtype == np.float32 else 1e-7)
    cosine = (found.astype(float) * normal).sum(axis=0)
    assert cosine.min() >= -1e-6


@dtypes
@pytest.mark.parametrize("normal", [(0, 0, 1), (0, 0, -1), (0.6, 0, -0.8), (-0.48, 0.64, 0.6)])
def test_bounces_have_the_density_of_the_cosine(
    dtype: type, normal: tuple[float, float, float]
) -> None:
    n = np.array(normal, float)
    found = diffuse_bounce(
        np.repeat(n[:, None], N, axis=1).astype(dtype), unit(2, N, dtype, seed=2)
    ).astype(float)
    a = np.cross(n, (0.0, 1.0, 0.0))
    a /= np.linalg.norm(a)
    turn = np.arctan2(np.cross(n, a) @ found, a @ found) / (2 * math.pi) % 1
    # Malley: seen along the normal the points fill the unit disk, so the squared cosine is uniform.
    assert_uniform(np.stack((np.clip(n @ found, 0, 1) ** 2, turn)), (24, 24))


def test_the_mean_of_what_arrives_is_the_irradiance_over_pi() -> None:
    """Radiance cos^k of the zenith angle on a floor: E / pi = 2 / (k + 2), and its variance in closed form."""
    normal = np.repeat([[0.0], [1.0], [0.0]], N, axis=1)
    height = diffuse_bounce(normal, unit(2, N, np.float64, seed=3))[1]
    for k in (1, 2, 5):
        assert_mean(height**k, 2 / (k + 2), 2 / (2 * k + 2) - (2 / (k + 2)) ** 2)


def test_neighbouring_numbers_give_neighbouring_directions() -> None:
    u = unit(2, 5000, np.float64, seed=4) * 0.98 + 0.01
    normal = directions(5000, np.float64, seed=5)
    moved = diffuse_bounce(normal, u + 1e-6) - diffuse_bounce(normal, u)
    assert np.linalg.norm(moved, axis=0).max() < 1e-4


# ---------------------------------------------------------------- throughput


@dtypes
def test_throughput_is_f_cos_over_pdf(dtype: type) -> None:
    beta, albedo = unit(3, 1000, dtype, seed=6) * 2, unit(3, 1000, dtype, seed=7)
    cos = np.random.default_rng(8).uniform(0.01, 1, 1000)
    expected = beta * (albedo / math.pi * cos) / (cos / math.pi)
    assert np.abs(throughput(beta, albedo) - expected).max() < 4e-7


def test_light_of_a_closed_room_adds_up() -> None:
    albedo = np.array([[0.2], [0.5], [0.9]])
    beta, total = np.ones((3, 1)), np.zeros((3, 1))
    for _ in range(400):
        total += beta
        beta = throughput(beta, albedo)
    assert total == pytest.approx(1 / (1 - albedo), rel=1e-12)


# ---------------------------------------------------------------- russian_roulette


@dtypes
def test_paths_survive_as_often_as_their_largest_channel_says(dtype: type) -> None:
    for color in ((0.3, 0.1, 0.2), (0.0, 0.75, 0.5), (0.01, 0.0, 0.001)):
        beta = np.repeat(np.array(color, dtype)[:, None], N, axis=1)
        survives, _ = russian_roulette(frozen(beta), frozen(unit(1, N, dtype, seed=9)[0]))
        q = max(color)
        assert_mean(survives, q, q * (1 - q))


@dtypes
@pytest.mark.parametrize("color", [(0.3, 0.1, 0.2), (0.0, 0.75, 0.5), (0.04, 0.01, 0.001)])
def test_the_mean_throughput_stays(dtype: type, color: tuple[float, float, float]) -> None:
    beta = np.repeat(np.array(color, dtype)[:, None], N, axis=1)
    _, after = russian_roulette(beta, unit(1, N, dtype, seed=10)[0])
    for value, channel in zip(after, color, strict=True):
        if channel:
            assert_mean(value, channel, channel**2 * (1 / max(color) - 1))
        else:
            assert not value.any()


@dtypes
def test_survivors_have_a_largest_channel_of_1_and_their_colour(dtype: type) -> None:
    beta = unit(3, 2000, dtype, seed=11)
    survives, after = russian_roulette(beta, unit(1, 2000, dtype, seed=12)[0])
    assert 0 < survives.sum() < 2000
    assert (after[:, ~survives] == 0).all()
    assert after[:, survives].max(axis=0) == pytest.approx(1, abs=1e-6)
    kept = beta[:, survives] / beta[:, survives].max(axis=0)
    assert np.abs(after[:, survives] - kept).max() < 1e-6


@dtypes
def test_bright_paths_are_left_alone_and_black_ones_end(dtype: type) -> None:
    last = np.nextafter(dtype(1), dtype(0))
    beta = np.array([[1, 7, 0, 0], [0, 2, 1, 0], [0.5, 0, 1, 0]], dtype)
    for number in (dtype(0), dtype(0.5), last):
        survives, after = russian_roulette(beta, np.full(4, number))
        assert survives.tolist() == [True, True, True, False]
        assert (after == beta).all()


@dtypes
def test_the_smallest_throughput_is_carried_or_ended(dtype: type) -> None:
    tiny = np.finfo(dtype).smallest_subnormal
    with np.errstate(all="raise"):
        survives, after = russian_roulette(np.full((3, 2), tiny), np.array([0, 0.5], dtype))
    assert survives.tolist() == [True, False]
    assert after.tolist() == [[1, 0]] * 3
