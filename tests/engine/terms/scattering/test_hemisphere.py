"""Directions with the density of the cosine: their distribution, and the normals and numbers that go wrong first.

Each statistical comparison fails for a right function with a probability of 1e-6 (tests/school/solutions/contract.py).
"""

import math
from itertools import product

import numpy as np
import pytest
from numpy.typing import NDArray

from course.engine.terms.scattering.hemisphere import cosine_directions
from tests.school.solutions.contract import assert_mean, assert_uniform, frozen, unit

Array = NDArray[np.floating]
N = 200_000
LAST = 1 - 2.0**-24
"""The largest number that a sampler gives."""

AXES = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]


def one_normal(normal: tuple[float, ...], n: int = N) -> Array:
    return np.repeat(np.array(normal, np.float32)[:, None], n, axis=1)


def worst_normals() -> Array:
    """Unit normals (3, N) around +-z, where bases are hard, and on the plane between, where the sign of z turns."""
    offsets = [0.0, *(s * 10.0**-k for k in range(1, 39) for s in (-1, 1)), 1e-45, -1e-45]
    normals = []
    for x, y in product(offsets, (0.0, -0.0, 1e-4, -1e-20, 0.5)):
        for sign in (-1, 1):
            normals += [(x, y, sign), (y, x, sign), (sign, y, x), (x, sign, y)]
    every = np.array(normals).T
    return (every / np.linalg.norm(every, axis=0)).astype(np.float32)


def cosines(normal: Array, direction: Array) -> Array:
    return np.einsum("kn,kn->n", normal.astype(float), direction.astype(float))


@pytest.mark.parametrize("normal", [*AXES, (0.6, 0, 0.8), (-0.48, 0.64, -0.6), (1e-4, 0, -1)])
def test_directions_fill_the_hemisphere_as_the_cosine_does(normal: tuple[float, ...]) -> None:
    # With density cos / pi the squared cosine and the azimuth are independent and uniform.
    n = one_normal(normal)
    d = cosine_directions(n, unit(2, N, seed=1)).astype(float)
    cosine = cosines(n, d)
    exact = np.array(normal) / np.linalg.norm(normal)
    # Any two axes of its tangent plane, by Gram and Schmidt.
    a = np.eye(3)[np.abs(exact).argmin()]
    a -= (a @ exact) * exact
    a /= np.linalg.norm(a)
    azimuth = np.arctan2(np.cross(exact, a) @ d, a @ d) / (2 * math.pi) + 0.5
    assert_uniform(np.stack((cosine**2, azimuth)), (20, 30))
    # The mean cosine is 2/3, its variance 1/2 - 4/9; tangents have the mean 0 and the variance 1/4.
    assert_mean(cosine, 2 / 3, 1 / 18)
    assert_mean(a @ d, 0, 1 / 4)
    assert_mean(np.cross(exact, a) @ d, 0, 1 / 4)


def test_normals_of_one_batch_do_not_mix() -> None:
    rng = np.random.default_rng(2)
    n = rng.normal(size=(3, N))
    n = (n / np.linalg.norm(n, axis=0)).astype(np.float32)
    u = unit(2, N, seed=3)
    d = cosine_directions(n, u)
    # Given u, the cosine is the same about every normal.
    assert np.abs(cosines(n, d) - np.sqrt(1 - u[0].astype(float))).max() < 1e-6
    # All that is left is the azimuth: over random normals the directions are uniform on the sphere.
    assert_uniform(
        np.stack((d[2] / 2 + 0.5, np.arctan2(d[1], d[0]) / (2 * math.pi) + 0.5)), (20, 30)
    )
    each = np.concatenate(
        [cosine_directions(n[:, i : i + 1], u[:, i : i + 1]) for i in range(100)], axis=1
    )
    assert (each == d[:, :100]).all()


@pytest.mark.parametrize("u1", [0, 0.125, 0.25, 0.5, 0.75, LAST])
@pytest.mark.parametrize("u0", [0, 2.0**-149, 2.0**-24, 0.25, 0.5, LAST])
def test_worst_normals_and_numbers_give_unit_directions_above_the_surface(
    u0: float, u1: float
) -> None:
    n = worst_normals()
    u = np.repeat(np.array([[u0], [u1]], np.float32), n.shape[1], axis=1)
    d = cosine_directions(n, u)
    assert np.isfinite(d).all()
    # Seven products and sums of numbers up to 1 in single precision.
    error = 7 * np.finfo(np.float32).eps
    assert np.abs(np.linalg.norm(d.astype(float), axis=0) - 1).max() < error
    assert np.abs(cosines(n, d) - math.sqrt(1 - u0)).max() < error
    if u0 == 0:
        assert (d == n).all(), "the middle of the disk is the normal"
    if u0 == LAST:
        assert cosines(n, d).min() > 0, "2^-12 above the surface, a thousand times the rounding"


def test_tangents_are_at_right_angles_everywhere() -> None:
    # On the rim a quarter turn of u leads from one tangent to the other.
    n = worst_normals()
    a, b, c = (
        cosine_directions(n, np.repeat([[np.float32(LAST)], [np.float32(u1)]], n.shape[1], axis=1))
        for u1 in (0, 0.25, 0.5)
    )
    # They stand 2^-12 above the plane, which is 2^-24 of a cosine.
    assert np.abs(cosines(a, b)).max() < 1e-6
    assert np.abs(cosines(a, c) + 1).max() < 1e-6
    assert np.abs(np.cross(a, b, axis=0) - n).max() < 4 * 2.0**-12
    handed = cosines(np.cross(a.astype(float), b.astype(float), axis=0), n)
    assert handed.min() > 0.99, "all of one handedness"


def test_what_is_given_is_not_written_to_and_what_is_returned_is_float32() -> None:
    n, u = frozen(worst_normals()), frozen(unit(2, worst_normals().shape[1]))
    d = cosine_directions(n, u)
    assert d.dtype == np.float32
    assert not np.shares_memory(d, n)
    assert cosine_directions(n[:, :0], u[:, :0]).shape == (3, 0)
