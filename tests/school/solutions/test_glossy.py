"""Glossy reflection: bases about all directions, the largest ball, and directions in the surface."""

import math

import numpy as np
import pytest

from course.school.grading.checks.laws import DTYPES
from tests.school.solutions.contract import (
    SOLUTIONS,
    Array,
    assert_unit,
    directions,
    every_pair,
    frozen,
    worst_directions,
)

orthonormal_basis = SOLUTIONS.function("glossy", "orthonormal_basis")
jitter_in_ball = SOLUTIONS.function("glossy", "jitter_in_ball")
keep_above = SOLUTIONS.function("glossy", "keep_above")


dtypes = pytest.mark.parametrize("dtype", DTYPES)


def repeated(axis: tuple[float, float, float], n: int, dtype: type) -> Array:
    """The same direction n times, unit length to the dtype's rounding."""
    return np.repeat((np.array(axis) / np.linalg.norm(axis)).astype(dtype)[:, None], n, axis=1)


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
