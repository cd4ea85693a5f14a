"""Textures: places on rectangles, spheres and triangles, and the colours of a repeated picture."""

from __future__ import annotations

import re

import numpy as np
import pytest

from course.grading.checks.laws import DTYPES
from tests.solutions.contract import SOLUTIONS, Array, directions, frozen, unit, worst_directions

rectangle_uv = SOLUTIONS.function("textures", "rectangle_uv")
sphere_uv = SOLUTIONS.function("textures", "sphere_uv")
triangle_uv = SOLUTIONS.function("textures", "triangle_uv")
texture_lookup = SOLUTIONS.function("textures", "texture_lookup")

P1, P2, P3 = np.array((1.0, 2, 3)), np.array((3.0, 2, 3)), np.array((1.0, 2, -1))
"""A rectangle of 2 x 4."""

IMAGE = np.random.default_rng(0).random((4, 7, 3))

CORNERS = {"uv0": np.array((0.1, 0.2)), "uv1": np.array((0.9, 0.3)), "uv2": np.array((0.4, 0.8))}

dtypes = pytest.mark.parametrize("dtype", DTYPES)


@pytest.mark.parametrize(
    "shape", [(), (4, 7), (4, 7, 4), (3, 4, 7), (1, 4, 7, 3), (0, 7, 3), (4, 0, 3)]
)
def test_pictures_of_another_shape_are_refused(shape: tuple[int, ...]) -> None:
    message = f"image must have shape (H, W, 3) with H, W >= 1, got {shape}"
    with pytest.raises(ValueError, match=f"^{re.escape(message)}$"):
        texture_lookup(np.ones(shape), np.ones((2, 5)))


def test_rectangles_without_extent_are_refused() -> None:
    for name, corners in (("p2", (P1, P1, P3)), ("p3", (P1, P2, P1))):
        with pytest.raises(ValueError, match=f"^{name} must be another point than p1, got "):
            rectangle_uv(np.ones((3, 5)), *corners)


# ---------------------------------------------------------------- rectangles


@dtypes
def test_rectangles_of_any_size_and_turn(dtype: type) -> None:
    rng = np.random.default_rng(1)
    for size in (1e-3, 1.0, 1e3):
        frame = np.linalg.qr(rng.standard_normal((3, 3)))[0]
        p1 = size * rng.uniform(-1, 1, 3)
        a, b, normal = size * frame[0], 3 * size * frame[1], size * frame[2]
        uv, off = rng.uniform(-1, 2, (2, 500)), rng.uniform(-1, 1, 500)
        p = p1[:, None] + np.outer(a, uv[0]) + np.outer(b, uv[1]) + np.outer(normal, off)
        found = rectangle_uv(p.astype(dtype), p1, p1 + a, p1 + b)
        assert np.abs(found - uv).max() < 50 * np.finfo(dtype).eps


# ---------------------------------------------------------------- spheres


@dtypes
def test_places_on_a_sphere_are_in_range_and_lead_back(dtype: type) -> None:
    d = np.concatenate((worst_directions(dtype), directions(5000, dtype, 2)), axis=1)
    u, v = found = sphere_uv(frozen(d), np.zeros(3))
    assert found.min() >= 0
    assert found.max() <= 1
    phi, theta = 2 * np.pi * u.astype(float), np.pi * v.astype(float)
    s = np.sin(theta)
    back = np.stack((s * np.cos(phi), -np.cos(theta), -s * np.sin(phi)))
    exact = d / np.linalg.norm(d.astype(float), axis=0)
    assert np.abs(back - exact).max() < 10 * np.finfo(dtype).eps


# ---------------------------------------------------------------- triangles


@dtypes
def test_corners_and_middle_of_a_triangle(dtype: type) -> None:
    corners = np.stack([*CORNERS.values()], axis=1)
    found = triangle_uv(np.eye(3, dtype=dtype), **CORNERS)
    assert (found == corners.astype(dtype)).all()
    middle = triangle_uv(np.full((3, 1), 1 / 3, dtype), **CORNERS)[:, 0]
    assert middle == pytest.approx(corners.mean(axis=1), rel=1e-6)


# ---------------------------------------------------------------- the lookup


def centers(height: int, width: int) -> tuple[Array, Array]:
    """Places (H, W) of the texels' centres, u and v; row 0 is on top, where v is 1."""
    j, i = np.indices((height, width))
    return (i + 0.5) / width, 1 - (j + 0.5) / height


@dtypes
def test_bilinear_pictures_are_exact_inside(dtype: type) -> None:
    def colors(u: Array, v: Array) -> Array:
        return np.stack((0.2 + 0.5 * u, 0.9 - 0.7 * v, 0.1 + 0.3 * u + 0.2 * v - 0.4 * u * v), -1)

    image = colors(*centers(5, 9)).astype(dtype)
    uv = unit(2, 2000, dtype, 6) * dtype(0.8) + dtype(0.1)
    expected = colors(*uv.astype(float)).T
    assert np.abs(texture_lookup(image, uv) - expected).max() < 30 * np.finfo(dtype).eps


def test_the_picture_repeats_without_a_seam() -> None:
    uv = unit(2, 2000, np.float64, 7)
    whole = np.random.default_rng(8).integers(-9, 10, uv.shape)
    first = texture_lookup(IMAGE, uv)
    assert np.abs(texture_lookup(IMAGE, uv + whole) - first).max() < 1e-12
    for edge in (0.0, 1.0, -2.0):
        for row in (0, 1):
            sides = uv.copy(), uv.copy()
            for side, step in zip(sides, (-1e-10, 1e-10), strict=True):
                side[row] = edge + step
            below, above = (texture_lookup(IMAGE, side) for side in sides)
            assert np.abs(below - above).max() < 1e-8


@dtypes
def test_the_worst_places_have_colours_of_the_picture(dtype: type) -> None:
    tiny = float(np.finfo(dtype).smallest_subnormal)
    ends = [0, tiny, -tiny, 1e-9, -1e-9, 0.5, 1 - 2.0**-24, 1, 1e6 + 0.25, -1e6, 1e30, -1e30]
    uv = np.stack([x.ravel() for x in np.meshgrid(ends, ends)]).astype(dtype)
    for image in (IMAGE, IMAGE[:1], IMAGE[:, :1], IMAGE[:1, :1]):
        found = texture_lookup(image, uv)
        assert found.min() >= image.min() - 1e-6
        assert found.max() <= image.max() + 1e-6
