"""Area lights: grids of point lights, and uniform points on rectangles, spheres, balls and disks."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest

from course.grading.checks.laws import DTYPES
from tests.solutions.contract import (
    SOLUTIONS,
    Array,
    assert_uniform,
    unit,
    worst_units,
)

light_grid = SOLUTIONS.function("soft_shadows", "light_grid")
point_on_rectangle = SOLUTIONS.function("soft_shadows", "point_on_rectangle")
point_on_sphere = SOLUTIONS.function("soft_shadows", "point_on_sphere")
point_in_ball = SOLUTIONS.function("soft_shadows", "point_in_ball")
point_on_facing_disk = SOLUTIONS.function("soft_shadows", "point_on_facing_disk")

CORNER, EDGE_U, EDGE_V = np.array([(1.0, -2.0, 0.5), (2.0, 0.5, 0.25), (-0.5, 1.0, 3.0)])
CENTER, RADIUS = np.array((0.5, -1.0, 2.0)), 0.75
ORIGIN = np.zeros(3)

dtypes = pytest.mark.parametrize("dtype", DTYPES)


@dataclass(frozen=True)
class Warp:
    """A function of the module with arguments that are fine."""

    function: Callable[..., Array]
    singles: dict[str, Any]
    batches: dict[str, int]
    """Names of the batch arguments, with their rows."""

    def __call__(self, u: Array, **changed: Any) -> Array:
        """Call it by name; where a shading point is asked for, they lie on a skew line."""
        given = {**self.singles, "u": u[: self.batches["u"]]}
        if "point" in self.batches:
            given["point"] = np.linspace(-1, 2, 3 * u.shape[1], dtype=u.dtype).reshape(3, -1)
        return self.function(**{**given, **changed})


RECTANGLE = {"corner": CORNER, "edge_u": EDGE_U, "edge_v": EDGE_V}
BALL = {"center": CENTER, "radius": RADIUS}
WARPS = {
    "point_on_rectangle": Warp(point_on_rectangle, RECTANGLE, {"u": 2}),
    "point_on_sphere": Warp(point_on_sphere, BALL, {"u": 2}),
    "point_in_ball": Warp(point_in_ball, BALL, {"u": 3}),
    "point_on_facing_disk": Warp(point_on_facing_disk, BALL, {"point": 3, "u": 2}),
}
ROUND = [name for name in WARPS if name != "point_on_rectangle"]

round_lights = pytest.mark.parametrize("name", ROUND)


def column(single: Any) -> Array:
    """A single point as (3, 1) float64."""
    return np.array(single, float)[:, None]


# ---------------------------------------------------------------- the grid of point lights


@pytest.mark.parametrize("single", [np.float32, np.float64])
def test_the_grid_is_float32_whatever_its_points_are(single: Callable[..., Any]) -> None:
    grid = light_grid(single(CORNER), single(EDGE_U), single(EDGE_V), np.int64(2))
    assert grid.dtype == np.float32
    assert (grid == light_grid(CORNER, EDGE_U, EDGE_V, 2)).all()
    assert light_grid(*single(4 * np.eye(3)), 2).T.tolist() == [
        [4, 1, 1],
        [4, 3, 1],
        [4, 1, 3],
        [4, 3, 3],
    ]


@pytest.mark.parametrize("size", [0.0, 1e-6, 1e6])
def test_the_grid_is_finite_for_the_smallest_and_the_largest_light(size: float) -> None:
    edges = np.array([[size, 0, 0], [0, -size, size]], np.float32)
    grid = light_grid(np.array([-size, size, size], np.float32), *edges, 3)
    assert np.isfinite(grid).all()
    assert np.abs(grid.astype(float)).max() <= 2 * size * (1 + 1e-7)


@pytest.mark.parametrize("k", [0, -3])
def test_a_grid_without_cells_is_refused(k: int) -> None:
    with pytest.raises(ValueError, match=f"^k must be >= 1, got {k}$"):
        light_grid(CORNER, EDGE_U, EDGE_V, k)


# ---------------------------------------------------------------- the rectangle


def test_a_rectangle_without_extent_is_its_corner() -> None:
    corner = np.array(CORNER, np.float32) / 3
    points = point_on_rectangle(corner, ORIGIN, ORIGIN, unit(2, 100))
    np.testing.assert_array_max_ulp(points, np.repeat(corner[:, None], 100, axis=1), 4)


# ---------------------------------------------------------------- sphere and ball


@dtypes
def test_sphere_points_lie_on_the_sphere_next_to_its_poles_too(dtype: type) -> None:
    near = dtype(2) ** -np.arange(60, dtype=dtype)
    ends = np.concatenate((near, 1 - near, worst_units(1, dtype)[0]))
    u = np.stack([x.ravel() for x in np.meshgrid(ends[ends < 1], ends[ends < 1])])
    points = point_on_sphere(ORIGIN, 1, u)
    assert np.abs(np.linalg.norm(points, axis=0) - 1).max() < 4 * np.finfo(dtype).eps


# ---------------------------------------------------------------- the facing disk


@dtypes
@pytest.mark.parametrize("scale", [1e-6, 1e-3, 1e3, 1e6])
def test_the_disk_faces_points_at_any_distance(dtype: type, scale: float) -> None:
    points = ((unit(3, 1000, dtype, seed=7) - dtype(0.5)) * dtype(scale)).astype(dtype)
    disk = point_on_facing_disk(ORIGIN, 1.0, points, unit(2, 1000, dtype, seed=8))
    axis = points / np.abs(points).max(axis=0)
    assert np.abs((disk * axis).sum(axis=0)).max() < 1e-6
    assert_uniform(np.clip((disk**2).sum(axis=0), 0, 1)[None], (20,))


# ---------------------------------------------------------------- the contract, for all of them


@round_lights
@dtypes
@pytest.mark.parametrize("scalar", [float, int, np.float32, np.float64, np.longdouble, np.array])
def test_the_radius_does_not_change_the_dtype(
    name: str, dtype: type, scalar: Callable[..., Any]
) -> None:
    points = WARPS[name](unit(3, 50, dtype), radius=scalar(2.0))
    assert points.dtype == dtype
    assert points == pytest.approx(WARPS[name](unit(3, 50, dtype), radius=2.0))


@pytest.mark.parametrize("point_dtype", DTYPES)
@pytest.mark.parametrize("u_dtype", DTYPES)
def test_mixed_batches_give_the_promoted_dtype(point_dtype: type, u_dtype: type) -> None:
    point, u = unit(3, 50, point_dtype, seed=1), unit(2, 50, u_dtype, seed=2)
    disk = point_on_facing_disk(CENTER, RADIUS, point, u)
    assert disk.dtype == np.promote_types(point_dtype, u_dtype)
    exact = point_on_facing_disk(CENTER, RADIUS, point.astype(float), u.astype(float))
    assert np.abs(disk - exact).max() < 2e-6
    # The centre is rounded to that dtype and to no other.
    center = np.array((0.1, -0.2, 0.3))
    only_center = point_on_facing_disk(center, 0, point, u)
    expected = np.repeat(center.astype(disk.dtype)[:, None], 50, axis=1)
    np.testing.assert_array_max_ulp(only_center, expected, 4)


@dtypes
@pytest.mark.parametrize("size", [0.0, 1e-6, 1e-3, 1.0, 1e3, 1e6, -1e6])
def test_rectangle_points_are_finite_for_the_worst_inputs(dtype: type, size: float) -> None:
    u = worst_units(2, dtype)
    edges = np.array([(size, 0, -size), (size, size, size)])
    for corner in np.array([(0, 0, 0), (size, -size, size), (1e-6, 1.0, -1e6)]):
        points = point_on_rectangle(corner, *edges, u)
        assert points.dtype == dtype
        assert np.isfinite(points).all()


@round_lights
@dtypes
@pytest.mark.parametrize("radius", [0.0, 1e-6, 1e-3, 1.0, 1e3, 1e6])
@pytest.mark.parametrize("size", [0.0, 1e-6, 1e-3, 1.0, 1e3, 1e6])
def test_round_lights_are_finite_and_in_reach_for_the_worst_inputs(
    name: str, dtype: type, radius: float, size: float
) -> None:
    u = worst_units(3, dtype)
    for center in np.array([(size, size, size), (-size, 0, size)]):
        points = WARPS[name](u, center=center, radius=radius)
        assert points.dtype == dtype
        assert np.isfinite(points).all()
        # What is exact is within the radius; the rest is rounding, of the radius and of the centre.
        reach = radius * (1 + 4 * np.finfo(dtype).eps) + 2 * np.finfo(dtype).eps * size
        assert np.abs(points - column(center.astype(dtype))).max() <= reach


@dtypes
def test_the_disk_is_finite_wherever_the_point_is(dtype: type) -> None:
    sizes = [0.0, 1e-6, 1e-3, 1.0, 1e3, 1e6]
    ends = [sign * size for size in sizes for sign in (1, -1)]
    points = np.array(np.meshgrid(ends, ends, ends), dtype).reshape(3, -1)
    u = unit(2, points.shape[1], dtype)
    for center in (0.0, 1e-6, -1.0, 1e6, -1e6):
        disk = point_on_facing_disk(np.array((center, 0, -center)), 1.0, points, u)
        assert np.isfinite(disk).all()


@round_lights
@dtypes
@pytest.mark.parametrize("center", [(0.5, -1, 2), (1e-3, 1 / 3, -1e6), (1e6, -1e-6, 0), (0, 0, 0)])
def test_radius_zero_gives_the_centre(
    name: str, dtype: type, center: tuple[float, float, float]
) -> None:
    for u in (worst_units(3, dtype), unit(3, 100, dtype)):
        expected = np.repeat(np.array(center, dtype)[:, None], u.shape[1], axis=1)
        for radius in (0, 0.0, -0.0, np.float64(0)):
            points = WARPS[name](u, center=np.array(center, float), radius=radius)
            np.testing.assert_array_max_ulp(points, expected, 4)


@round_lights
@pytest.mark.parametrize("radius", [-1, -1e-45, math.nan, math.inf, np.float64(-2)])
def test_a_radius_out_of_range_is_refused(name: str, radius: float) -> None:
    with pytest.raises(ValueError, match=f"^radius must be finite and >= 0, got {radius}$"):
        WARPS[name](unit(3, 5), radius=radius)
