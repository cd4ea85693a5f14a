"""Path tracing: cosine-distributed bounces, what they leave of the light, and Russian roulette without bias."""

from __future__ import annotations

import math

import numpy as np
import pytest

from course.grading.checks.laws import DTYPES
from tests.solutions.contract import (
    SOLUTIONS,
    assert_unit,
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


# ---------------------------------------------------------------- throughput


@dtypes
def test_throughput_is_f_cos_over_pdf(dtype: type) -> None:
    beta, albedo = unit(3, 1000, dtype, seed=6) * 2, unit(3, 1000, dtype, seed=7)
    cos = np.random.default_rng(8).uniform(0.01, 1, 1000)
    expected = beta.astype(float) * (albedo.astype(float) / math.pi * cos) / (cos / math.pi)
    assert np.abs(throughput(beta, albedo) - expected).max() < 4 * np.finfo(dtype).eps


# ---------------------------------------------------------------- russian_roulette


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
