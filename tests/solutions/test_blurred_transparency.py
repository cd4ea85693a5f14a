"""Blurred transparency: refraction, the lobe about the refracted direction, and what the boundary reflects."""

from __future__ import annotations

import math

import numpy as np
import pytest

from course.grading.checks.laws import DTYPES
from tests.solutions.contract import (
    SOLUTIONS,
    Array,
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

MODULE = "blurred_transparency"
refract = SOLUTIONS.function(MODULE, "refract")
jitter_refraction = SOLUTIONS.function(MODULE, "jitter_refraction")
fresnel = SOLUTIONS.function(MODULE, "fresnel")

N = 100_000

ETAS = [0.1, 1 / 1.5, 1.0, 1.33, 2.4, 10.0]


def facing(direction: Array, normal: Array) -> Array:
    """The normals on the incoming side; what has no columns, or too many, comes back as it is."""
    if np.shape(direction) != np.shape(normal) or np.shape(normal)[:1] != (3,):
        return normal
    return np.where((direction.astype(float) * normal).sum(axis=0) > 0, -normal, normal)


dtypes = pytest.mark.parametrize("dtype", DTYPES)
etas = pytest.mark.parametrize("eta", ETAS)


@pytest.mark.parametrize("shape", [(4,), (1, 5), (5, 1), (0,)])
def test_an_eta_of_another_shape_is_refused(shape: tuple[int, ...]) -> None:
    d = directions(5, np.float32, 0)
    for call in (lambda eta: refract(d, -d, eta), lambda eta: fresnel(np.ones(5), eta)):
        with pytest.raises(ValueError, match=r"^eta must be a number or have shape \(5,\), got "):
            call(np.ones(shape))


@pytest.mark.parametrize("wrong", [0, -1.0, 0.09, 10.1, math.nan, math.inf])
def test_an_eta_out_of_range_is_refused(wrong: float) -> None:
    d = directions(5, np.float32, 0)
    for eta in (wrong, np.array([1, 1, wrong, 1, 1])):
        with pytest.raises(ValueError, match=r"^eta must be from 0\.1 to 10, got "):
            refract(d, -d, eta)
        with pytest.raises(ValueError, match=r"^eta must be from 0\.1 to 10, got "):
            fresnel(np.ones(5), eta)


def rays(sine: Array, dtype: type, seed: int = 0) -> tuple[Array, Array]:
    """Directions and normals with those sines between them."""
    n = directions(sine.size, np.float64, seed)
    along = np.cross(n.T, directions(sine.size, np.float64, seed + 1).T).T
    along /= np.linalg.norm(along, axis=0)
    return (sine * along - np.sqrt(1 - sine**2) * n).astype(dtype), n.astype(dtype)


def angle(a: Array, b: Array) -> Array:
    """Between unit vectors, without cancellation."""
    a, b = a.astype(float), b.astype(float)
    return 2 * np.arctan2(np.linalg.norm(a - b, axis=0), np.linalg.norm(a + b, axis=0))


# ---------------------------------------------------------------- refraction


@dtypes
@etas
def test_directions_are_unit_length_for_the_worst_inputs(dtype: type, eta: float) -> None:
    d, n = every_pair(worst_directions(dtype)[:, ::9], worst_directions(dtype)[:, ::9])
    # Normalised again: this is about what refraction adds to their own rounding.
    d, n = ((v / np.linalg.norm(v.astype(float), axis=0)).astype(dtype) for v in (d, n))
    result, total = refract(frozen(d), frozen(facing(d, n)), eta)
    assert_unit(result)
    assert total.dtype == np.bool_
    # Between equal media rounding decides along the surface.
    assert eta == 1 or total.any() == (eta > 1)


@dtypes
@etas
def test_angles_follow_from_snells_law(dtype: type, eta: float) -> None:
    i = np.linspace(0, min(math.pi / 2, math.asin(min(1, 1 / eta))) - 0.03, 1000)
    d, n = rays(np.sin(i), dtype)
    result, total = refract(d, n, eta)
    assert not total.any()
    t = angle(result, -n)
    rounding = 100 * float(np.finfo(dtype).eps) * max(1, eta)
    assert np.abs(t - np.arcsin(eta * np.sin(i))).max() < rounding
    # In one plane, on the other side of the normal's line, and on the far side of the surface.
    volume = np.einsum("ij,ij->j", np.cross(d.T, n.T).T.astype(float), result.astype(float))
    assert np.abs(volume).max() < rounding
    along = d + np.einsum("ij,ij->j", -d, n) * n
    assert ((along * result).sum(axis=0) >= -rounding).all()
    assert ((result * n).sum(axis=0) < 0).all()


@pytest.mark.parametrize("eta", [1.33, 1.5, 2.4])
def test_reflection_is_total_beyond_the_critical_angle(eta: float) -> None:
    critical = math.asin(1 / eta)
    for step, expected in ((-1e-6, False), (1e-6, True)):
        d, n = rays(np.full(200, math.sin(critical + step)), np.float64)
        result, total = refract(d, n, eta)
        assert (total == expected).all()
        if expected:
            assert np.abs(result - (d - 2 * (d * n).sum(axis=0) * n)).max() < 1e-14


def test_light_takes_the_same_way_back() -> None:
    for eta in ETAS:
        d, n = rays(np.linspace(0, 0.999 * min(1, 1 / eta), 500), np.float64)
        there, _ = refract(d, n, eta)
        back, total = refract(-there, -n, 1 / eta)
        assert not total.any()
        assert np.abs(back + d).max() < 1e-10


# ---------------------------------------------------------------- the lobe


def down(cos: float, n: int, dtype: type = np.float32, seed: int = 3) -> tuple[Array, Array]:
    """One refracted direction, n times, that goes down at a cosine; and its normal."""
    d, normal = rays(np.array([math.sqrt(1 - cos * cos)]), dtype, seed)
    return np.repeat(d, n, axis=1), np.repeat(normal, n, axis=1)


@dtypes
@pytest.mark.parametrize("roughness", [0.0, 1e-6, 0.1, 1.0, 1e3, 1e6])
def test_lobe_is_unit_length_and_on_the_far_side(dtype: type, roughness: float) -> None:
    w, u = worst_directions(dtype)[:, ::9], worst_units(2, dtype)
    w = (w / np.linalg.norm(w.astype(float), axis=0)).astype(dtype)
    d, u = every_pair(w, u)
    n = facing(d, directions(d.shape[1], dtype, 4))
    result = jitter_refraction(frozen(d), frozen(n), roughness, frozen(u))
    assert_unit(result, 1e-6)
    assert (result.astype(float) * n).sum(axis=0).max() < 1e-6


@pytest.mark.parametrize("d_dtype", DTYPES)
@pytest.mark.parametrize("u_dtype", DTYPES)
@pytest.mark.parametrize("zero", [0, 0.0, -0.0, np.float32(0)])
def test_no_jitter_gives_the_direction(d_dtype: type, u_dtype: type, zero: float) -> None:
    d = frozen(worst_directions(d_dtype))
    result = jitter_refraction(
        d, facing(d, directions(d.shape[1], d_dtype, 5)), zero, unit(2, d.shape[1], u_dtype, 6)
    )
    np.testing.assert_array_max_ulp(result, d.astype(result.dtype), 4)
    assert not np.shares_memory(result, d)


@pytest.mark.parametrize("wrong", [-1.0, -1e-45, math.nan, -math.inf])
def test_a_roughness_out_of_range_is_refused(wrong: float) -> None:
    d = directions(5, np.float32, 0)
    with pytest.raises(ValueError, match=f"^roughness must be >= 0, got {wrong}$"):
        jitter_refraction(d, -d, wrong, unit(2, 5))


@dtypes
@pytest.mark.parametrize("roughness", [0.01, 0.3, 0.9])
def test_lobe_is_a_uniform_square_of_that_side(dtype: type, roughness: float) -> None:
    d, n = down(0.9, N, dtype)
    u = unit(2, N, dtype, 7)
    u[:, :3] = np.array([[0, 1, 0], [0, 0, 1]])
    result = jitter_refraction(d, n, roughness, u).astype(float)
    w = d[:, 0] / np.linalg.norm(d[:, 0].astype(float))
    offset = result / (w @ result) - w[:, None]
    rounding = 30 * float(np.finfo(dtype).eps)
    a, b = offset[:, 1] - offset[:, 0], offset[:, 2] - offset[:, 0]
    assert [a @ a, b @ b] == pytest.approx([roughness**2] * 2, abs=rounding)
    assert a @ b == pytest.approx(0, abs=rounding)
    place = np.stack((a @ offset, b @ offset)) / roughness**2 + 0.5
    assert_uniform(np.clip(place[:, 3:], 0, 1), (24, 24))
    # A twelfth is the variance of a uniform number.
    for row in place:
        assert_mean(row[3:], 0.5, 1 / 12)


@dtypes
def test_what_came_back_is_mirrored_in_the_surface(dtype: type) -> None:
    d, n = down(0.2, 5000, dtype)
    u = unit(2, 5000, dtype, 8)
    # The same lobe about the same direction, straight down, where nothing comes back.
    free = jitter_refraction(d, -d, 0.9, u).astype(float)
    dot = (free * n).sum(axis=0)
    result = jitter_refraction(d, n, 0.9, u)
    assert 500 < (dot > 0).sum() < 2500
    assert np.abs(result - (free - 2 * np.maximum(dot, 0) * n)).max() < 10 * np.finfo(dtype).eps
    clear = dot < -1e-6
    assert (result[:, clear] == free[:, clear]).all()


# ---------------------------------------------------------------- what is reflected


@dtypes
@etas
def test_reflectance_at_the_ends(dtype: type, eta: float) -> None:
    beyond = np.array([-1e-6, 0.0, 1.0, 1 + 1e-6], dtype)
    result = fresnel(frozen(beyond), eta)
    assert (result[:2] == 1).all()
    assert result[2] == result[3]
    share = fresnel(unit(1, 5000, dtype, 9)[0], eta)
    assert share.min() >= 0
    assert share.max() <= 1


@pytest.mark.parametrize("n", [1.33, 1.5, 2.4])
def test_reflectance_by_sines_and_tangents(n: float) -> None:
    for eta in (n, 1 / n):
        i = np.linspace(0.01, math.asin(min(1, 1 / eta)) - 0.01, 500)
        t = np.arcsin(eta * np.sin(i))
        s = (np.sin(i - t) / np.sin(i + t)) ** 2
        p = (np.tan(i - t) / np.tan(i + t)) ** 2
        assert fresnel(np.cos(i), eta) == pytest.approx((s + p) / 2, rel=1e-9)
        # The other side of the boundary reflects the same share.
        assert fresnel(np.cos(t), 1 / eta) == pytest.approx((s + p) / 2, rel=1e-9)
