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
    assert_mean,
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
N = 100_000

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

warps = pytest.mark.parametrize("name", WARPS)
round_lights = pytest.mark.parametrize("name", ROUND)


def column(single: Any) -> Array:
    """A single point as (3, 1) float64."""
    return np.array(single, float)[:, None]


def in_unit_square(points: Array) -> Array:
    """Coordinates (2, N) along the edges of the test's parallelogram, which the points lie in."""
    edges = np.array([EDGE_U, EDGE_V, np.cross(EDGE_U, EDGE_V)]).T
    a, b, off = np.linalg.solve(edges, points - column(CORNER))
    assert np.abs(off).max() < 1e-6
    return np.stack((a, b))


def basis(w: Array) -> tuple[Array, Array]:
    """Two unit vectors orthogonal to w and to each other, by Gram and Schmidt."""
    helper = np.eye(3)[np.abs(w).argmin()]
    a = np.cross(w, helper)
    a /= np.linalg.norm(a)
    return a, np.cross(w, a)


def turn(x: Array, y: Array) -> Array:
    """The angle of (x, y) in turns, 0 to 1."""
    return np.arctan2(y, x) / (2 * np.pi) % 1


# ---------------------------------------------------------------- the grid of point lights


@pytest.mark.parametrize("k", [1, 2, 3, 8])
def test_the_grid_is_the_cell_centres_of_the_parallelogram(k: int) -> None:
    grid = light_grid(CORNER, EDGE_U, EDGE_V, k)
    assert grid.shape == (3, k * k)
    assert grid.dtype == np.float32
    cells = in_unit_square(grid.astype(float)) * k
    assert np.abs(cells % 1 - 0.5).max() < 1e-5
    assert {*map(tuple, cells.astype(int).T)} == {(i, j) for i in range(k) for j in range(k)}


def test_a_grid_of_one_is_the_lights_centre() -> None:
    centre = CORNER + 0.5 * EDGE_U + 0.5 * EDGE_V
    assert (light_grid(CORNER, EDGE_U, EDGE_V, 1)[:, 0] == centre.astype(np.float32)).all()


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


@dtypes
def test_rectangle_points_are_uniform_on_the_parallelogram(dtype: type) -> None:
    points = point_on_rectangle(CORNER, EDGE_U, EDGE_V, unit(2, N, dtype, seed=1))
    inside = in_unit_square(points.astype(float))
    assert inside.min() >= -1e-6
    assert inside.max() <= 1 + 1e-6
    inside = np.clip(inside, 0, 1)
    assert_uniform(inside, (32, 32))
    for row in inside:
        assert_mean(row, 1 / 2, 1 / 12)
        assert_mean(row**2, 1 / 3, 1 / 5 - 1 / 9)
    assert_mean(inside[0] * inside[1], 1 / 4, 1 / 9 - 1 / 16)


def test_a_rectangle_without_extent_is_its_corner() -> None:
    corner = np.array(CORNER, np.float32) / 3
    points = point_on_rectangle(corner, ORIGIN, ORIGIN, unit(2, 100))
    np.testing.assert_array_max_ulp(points, np.repeat(corner[:, None], 100, axis=1), 4)


# ---------------------------------------------------------------- sphere and ball


@dtypes
def test_sphere_points_are_uniform_on_the_surface(dtype: type) -> None:
    points = point_on_sphere(CENTER, RADIUS, unit(2, N, dtype, seed=2))
    direction = (points - column(CENTER)) / RADIUS
    assert np.abs(np.linalg.norm(direction, axis=0) - 1).max() < 1e-6
    # Archimedes: the coordinate along any axis is uniform, and so is the angle about it.
    for w in (np.eye(3)[0], np.eye(3)[1], np.eye(3)[2], np.array([2, -1, 2]) / 3):
        a, b = basis(w)
        height = np.clip((1 + w @ direction) / 2, 0, 1)
        assert_uniform(np.stack((height, turn(a @ direction, b @ direction))), (24, 24))
        assert_mean(w @ direction, 0, 1 / 3)
        assert_mean((w @ direction) ** 2, 1 / 3, 1 / 5 - 1 / 9)
    # The density of x y on the unit sphere has the variance E[x^2 y^2] = 1 / 15.
    assert_mean(direction[0] * direction[1], 0, 1 / 15)


@dtypes
def test_sphere_points_lie_on_the_sphere_next_to_its_poles_too(dtype: type) -> None:
    near = dtype(2) ** -np.arange(60, dtype=dtype)
    ends = np.concatenate((near, 1 - near, worst_units(1, dtype)[0]))
    u = np.stack([x.ravel() for x in np.meshgrid(ends[ends < 1], ends[ends < 1])])
    points = point_on_sphere(ORIGIN, 1, u)
    assert np.abs(np.linalg.norm(points, axis=0) - 1).max() < 4 * np.finfo(dtype).eps


@dtypes
def test_ball_points_are_uniform_in_the_volume(dtype: type) -> None:
    points = point_in_ball(CENTER, RADIUS, unit(3, N, dtype, seed=3))
    offset = (points - column(CENTER)) / RADIUS
    r = np.linalg.norm(offset, axis=0)
    assert r.max() <= 1 + 1e-6
    volume = np.clip(r**3, 0, 1)
    for w in (np.eye(3)[0], np.eye(3)[2], np.array([2, -1, 2]) / 3):
        a, b = basis(w)
        height = np.clip((1 + w @ offset / r) / 2, 0, 1)
        assert_uniform(np.stack((volume, height, turn(a @ offset, b @ offset))), (12, 12, 12))
        assert_mean(w @ offset, 0, 1 / 5)
        assert_mean((w @ offset) ** 2, 1 / 5, 3 / 35 - 1 / 25)
    assert_mean(r**2, 3 / 5, 3 / 7 - 9 / 25)


# ---------------------------------------------------------------- the facing disk

DIRECTIONS = [
    (1, 0, 0),
    (0, -1, 0),
    (0, 0, 1),
    (0, 0, -1),
    (2 / 3, -1 / 3, 2 / 3),
    # Next to -z, where Frisvad's basis falls to pieces.
    (0.00038527316, 0.00038460016, -0.99999988079),
    (-1e-7, 1e-20, -1.0),
]


@dtypes
@pytest.mark.parametrize("direction", DIRECTIONS)
def test_disk_points_are_uniform_on_the_disk_that_faces_the_point(
    dtype: type, direction: tuple[float, float, float]
) -> None:
    center = np.zeros(3)
    w = np.array(direction)
    points = np.repeat(-3 * w[:, None], N, axis=1).astype(dtype)
    disk = point_on_facing_disk(center, RADIUS, points, unit(2, N, dtype, seed=4)) / RADIUS
    w = w / np.linalg.norm(w)
    a, b = basis(w)
    x, y = a @ disk, b @ disk
    assert np.abs(w @ disk).max() < 1e-6
    r2 = x * x + y * y
    assert r2.max() <= 1 + 1e-6
    assert_uniform(np.stack((np.clip(r2, 0, 1), turn(x, y))), (24, 24))
    for along in (x, y):
        assert_mean(along, 0, 1 / 4)
        assert_mean(along**2, 1 / 4, 1 / 8 - 1 / 16)
    assert_mean(x * y, 0, 1 / 24)


@dtypes
def test_each_shading_point_gets_a_disk_of_its_own(dtype: type) -> None:
    points = (10 * unit(3, 5000, dtype, seed=5) - 5).astype(dtype)
    disk = point_on_facing_disk(CENTER, RADIUS, points, unit(2, 5000, dtype, seed=6))
    offset, axis = disk - column(CENTER), column(CENTER) - points
    assert np.abs((offset * axis).sum(axis=0) / np.linalg.norm(axis, axis=0)).max() < 1e-6
    r2 = (offset**2).sum(axis=0) / RADIUS**2
    assert_uniform(np.clip(r2, 0, 1)[None], (50,))


@dtypes
@pytest.mark.parametrize("scale", [1e-6, 1e-3, 1e3, 1e6])
def test_the_disk_faces_points_at_any_distance(dtype: type, scale: float) -> None:
    points = ((unit(3, 1000, dtype, seed=7) - dtype(0.5)) * dtype(scale)).astype(dtype)
    disk = point_on_facing_disk(ORIGIN, 1.0, points, unit(2, 1000, dtype, seed=8))
    axis = points / np.abs(points).max(axis=0)
    assert np.abs((disk * axis).sum(axis=0)).max() < 1e-6
    assert_uniform(np.clip((disk**2).sum(axis=0), 0, 1)[None], (20,))


@dtypes
def test_a_point_at_the_centre_gets_a_disk_of_any_orientation(dtype: type) -> None:
    n = 20_000
    points = np.repeat(CENTER.astype(dtype)[:, None], n, axis=1)
    disk = point_on_facing_disk(CENTER, RADIUS, points, unit(2, n, dtype, seed=9))
    offset = (disk - column(CENTER)) / RADIUS
    thickness, *extent = sorted(np.linalg.svd(offset / math.sqrt(n), compute_uv=False))
    assert thickness < 1e-6
    assert extent == pytest.approx([0.5, 0.5], rel=0.05)
    assert_uniform(np.clip((offset**2).sum(axis=0), 0, 1)[None], (100,))


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
