"""Glossy reflection: the basis about a direction, and the lobes of square, ball and Phong."""

from __future__ import annotations

import inspect
import math
from collections.abc import Callable
from itertools import product

import numpy as np
import pytest

from course.grading.checks.laws import DTYPES
from tests.solutions.contract import (
    SOLUTIONS,
    Array,
    assert_uniform,
    assert_unit,
    directions,
    every_pair,
    frozen,
    unit,
    worst_directions,
    worst_units,
)

orthonormal_basis = SOLUTIONS.function("glossy", "orthonormal_basis")
jitter_on_plane = SOLUTIONS.function("glossy", "jitter_on_plane")
jitter_in_ball = SOLUTIONS.function("glossy", "jitter_in_ball")
sample_phong_lobe = SOLUTIONS.function("glossy", "sample_phong_lobe")
keep_above = SOLUTIONS.function("glossy", "keep_above")

N = 100_000

Lobe = Callable[[Array, float, Array], Array]

LOBES: dict[str, tuple[Lobe, int, list[float]]] = {
    "jitter_on_plane": (jitter_on_plane, 2, [0.0, 1e-6, 0.1, 1.0, 1e3, 1e6]),
    "jitter_in_ball": (jitter_in_ball, 3, [0.0, 1e-6, 0.1, 0.9, 0.999999, 1 - 1e-9]),
    "sample_phong_lobe": (sample_phong_lobe, 2, [0.0, 1e-6, 1.0, 1e3, 1e6]),
}
"""Each lobe with the rows of its u and the sizes to try."""

AXES = [
    (0.0, 0.0, 1.0),
    (0.0, 0.0, -1.0),
    (2 / 3, -1 / 3, 2 / 3),
    # Next to -z, where Frisvad's basis falls to pieces.
    (0.00038527316, 0.00038460016, -0.99999988079),
]


dtypes = pytest.mark.parametrize("dtype", DTYPES)
axes = pytest.mark.parametrize("axis", AXES)
lobes = pytest.mark.parametrize("name", LOBES)


def repeated(axis: tuple[float, float, float], n: int, dtype: type) -> Array:
    """The same direction n times, unit length to the dtype's rounding."""
    return np.repeat((np.array(axis) / np.linalg.norm(axis)).astype(dtype)[:, None], n, axis=1)


def about(axis: tuple[float, float, float], result: Array) -> tuple[Array, Array]:
    """1 - cos(alpha) of each result, without cancellation, and its turn about the axis, 0 to 1."""
    w = np.array(axis) / np.linalg.norm(axis)
    a = np.cross(w, np.eye(3)[np.abs(w).argmin()])
    a /= np.linalg.norm(a)
    result = result / np.linalg.norm(result.astype(float), axis=0)
    turn = np.arctan2(np.cross(w, a) @ result, a @ result) / (2 * np.pi) % 1
    return ((result - w[:, None]) ** 2).sum(axis=0) / 2, turn


# ---------------------------------------------------------------- the basis


@dtypes
def test_basis_is_orthonormal_and_right_handed_for_every_unit_vector(dtype: type) -> None:
    w = np.concatenate((worst_directions(dtype), directions(10_000, dtype, 1)), axis=1)
    u, v = (x.astype(float) for x in orthonormal_basis(w))
    tolerance = 4 * np.finfo(dtype).eps
    exact = w / np.linalg.norm(w.astype(float), axis=0)
    if dtype is np.float64:
        # The vector of ten digits is unit length to 1e-7 only, and so is its basis.
        tolerance = np.maximum(tolerance, 2 * np.abs(np.linalg.norm(w, axis=0) - 1))
    for length in (np.linalg.norm(u, axis=0), np.linalg.norm(v, axis=0)):
        assert (np.abs(length - 1) <= tolerance).all()
    for dot in (u * v, u * exact, v * exact):
        assert (np.abs(dot.sum(axis=0)) <= tolerance).all()
    assert (np.abs(np.cross(u.T, v.T).T - exact) <= 2 * tolerance).all()


# ---------------------------------------------------------------- what all lobes have in common


@lobes
@dtypes
def test_lobes_are_unit_length_for_the_worst_inputs(name: str, dtype: type) -> None:
    lobe, rows, sizes = LOBES[name]
    d, u = every_pair(worst_directions(dtype), worst_units(rows, dtype))
    # Normalised again: this is about what the lobe adds to the direction's own rounding.
    d = (d / np.linalg.norm(d.astype(float), axis=0)).astype(dtype)
    for size in sizes:
        assert_unit(lobe(d, size, u), 1e-6)


@lobes
@dtypes
def test_lobes_stay_finite_where_a_number_was_rounded_to_1(name: str, dtype: type) -> None:
    lobe, rows, sizes = LOBES[name]
    u = np.array([*product([0.0, 0.5, 1.0], repeat=rows)], dtype).T
    for size in sizes:
        assert_unit(lobe(repeated(AXES[2], u.shape[1], dtype), size, u))


@pytest.mark.parametrize("name", ["jitter_on_plane", "jitter_in_ball"])
@pytest.mark.parametrize("d_dtype", DTYPES)
@pytest.mark.parametrize("u_dtype", DTYPES)
@pytest.mark.parametrize("zero", [0, 0.0, -0.0, np.float32(0)])
def test_no_jitter_gives_the_direction(
    name: str, d_dtype: type, u_dtype: type, zero: float
) -> None:
    lobe, rows, _ = LOBES[name]
    d = np.concatenate((worst_directions(d_dtype), directions(5000, d_dtype, 4)), axis=1)
    # Normalised again: what is unit length to ten digits only may be made so to more.
    d = (d / np.linalg.norm(d.astype(float), axis=0)).astype(d_dtype)
    for u in (unit(rows, d.shape[1], u_dtype, 5), np.zeros((rows, d.shape[1]), u_dtype)):
        locked = frozen(d)
        result = lobe(locked, zero, u)
        np.testing.assert_array_max_ulp(result.astype(d_dtype), d, 4)
        assert not np.shares_memory(result, locked)


@lobes
@pytest.mark.parametrize("wrong", [-1.0, -1e-45, math.nan, -math.inf])
def test_sizes_out_of_range_are_refused(name: str, wrong: float) -> None:
    lobe, rows, _ = LOBES[name]
    argument = list(inspect.signature(lobe).parameters)[1]
    text = ">= 0 and < 1" if argument == "glossiness" else ">= 0"
    with pytest.raises(ValueError, match=f"^{argument} must be {text}, got {wrong}$"):
        lobe(directions(5, np.float32, 0), wrong, unit(rows, 5))


@pytest.mark.parametrize("wrong", [1, 1.0, 1.5, math.inf])
def test_a_ball_that_reaches_the_origin_is_refused(wrong: float) -> None:
    with pytest.raises(ValueError, match=f"^glossiness must be >= 0 and < 1, got {wrong}$"):
        jitter_in_ball(directions(5, np.float32, 0), wrong, unit(3, 5))


# ---------------------------------------------------------------- the square


@dtypes
@axes
@pytest.mark.parametrize("roughness", [0.01, 0.5, 1.0, 3.0])
def test_square_is_a_square_of_that_side_about_the_direction(
    dtype: type, axis: tuple[float, float, float], roughness: float
) -> None:
    u = np.concatenate((np.array([[0, 1, 0, 1], [0, 0, 1, 1]], dtype), unit(2, 500, dtype)), axis=1)
    d = repeated(axis, u.shape[1], dtype)
    w = d[:, 0] / np.linalg.norm(d[:, 0].astype(float))
    result = jitter_on_plane(d, roughness, u).astype(float)
    # Onto the plane at distance 1.
    offset = result / (w @ result) - w[:, None]
    rounding = 30 * float(np.finfo(dtype).eps) * (1 + roughness**2)
    assert np.abs(w @ offset).max() <= rounding
    a, b = offset[:, 1] - offset[:, 0], offset[:, 2] - offset[:, 0]
    assert [a @ a, b @ b] == pytest.approx([roughness**2] * 2, abs=rounding)
    assert a @ b == pytest.approx(0, abs=rounding)
    expected = a[:, None] * (u[0] - 0.5) + b[:, None] * (u[1] - 0.5)
    assert np.abs(offset - expected).max() <= rounding


# ---------------------------------------------------------------- the ball


@dtypes
def test_a_ball_that_all_but_reaches_the_origin_still_gives_directions(dtype: type) -> None:
    """Points of the ball right behind the direction's tail, where the sum all but vanishes."""
    near = dtype(2) ** -np.arange(1, 30, dtype=dtype)
    ends = np.concatenate(([0], near, 1 - near)).astype(dtype)
    last = np.nextafter(dtype(1), dtype(0))
    u = np.stack([x.ravel() for x in np.meshgrid(ends, [0, 0.25, 0.5, 0.75], [0.5, last])])
    u = u.astype(dtype)[:, u.max(axis=0) < 1]
    units = np.concatenate((np.eye(3), -np.eye(3)), axis=1).astype(dtype)
    d, u = every_pair(units, u)
    for glossiness in (0.999, 1 - 1e-7, 1 - 1e-9, math.nextafter(1, 0)):
        assert_unit(jitter_in_ball(d, glossiness, u))


# ---------------------------------------------------------------- the lobe of Phong


@dtypes
@axes
@pytest.mark.parametrize("exponent", [10, 1e6])
def test_phong_lobe_has_its_density(
    dtype: type, axis: tuple[float, float, float], exponent: float
) -> None:
    d = repeated(axis, N, dtype)
    result = sample_phong_lobe(d, exponent, unit(2, N, dtype, seed=13))
    h, turn = about(tuple(d[:, 0].astype(float)), result)
    # The share of the lobe within alpha: 1 - cos^(exponent + 1).
    share = -np.expm1((exponent + 1) * np.log1p(-np.minimum(h, 1 - 1e-9)))
    assert_uniform(np.stack((share, turn)), (24, 24))


# ---------------------------------------------------------------- keeping above


@dtypes
def test_directions_above_the_surface_come_back_bit_for_bit(dtype: type) -> None:
    d, n = every_pair(worst_directions(dtype), directions(50, dtype, 17))
    above = (d.astype(float) * n).sum(axis=0) >= 1e-6
    kept = keep_above(frozen(d), frozen(n))
    assert above.sum() > 1000
    assert (kept[:, above] == d[:, above]).all()
    # Exactly in the surface, nothing is to be done.
    plus_z = repeated((0, 0, 1), d.shape[1], dtype)
    flat = d[2] == 0
    assert flat.sum() > 50
    assert (keep_above(d, plus_z)[:, flat] == d[:, flat]).all()
