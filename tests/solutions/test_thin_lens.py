"""Depth of field: points on the lens, rays through the plane in focus, and the circle of confusion."""

from __future__ import annotations

import math
from fractions import Fraction
from itertools import product
from typing import Any

import numpy as np
import pytest

from course.grading.checks.laws import DTYPES
from tests.solutions.contract import (
    SOLUTIONS,
    Array,
    assert_unit,
    every_pair,
    frozen,
    unit,
    worst_units,
)

point_on_disk = SOLUTIONS.function("thin_lens", "point_on_disk")
lens_rays = SOLUTIONS.function("thin_lens", "lens_rays")
image_distance = SOLUTIONS.function("thin_lens", "image_distance")
circle_of_confusion = SOLUTIONS.function("thin_lens", "circle_of_confusion")


ORIGIN = np.array((0.3, -1.7, 2.1))
# A camera that looks along no axis.
RIGHT, UP, FORWARD = np.array([(2, -1, 2), (2, 2, -1), (-1, 2, 2)]) / 3
CAMERA = {"origin": ORIGIN, "right": RIGHT, "up": UP, "forward": FORWARD}
AXES = np.array([RIGHT, UP, FORWARD]).T

CORNERS = [*product((-1.0, 0.0, 1.0), repeat=2)]
"""Places in a picture of a right angle both ways: its corners, its edges' middles and its middle."""

dtypes = pytest.mark.parametrize("dtype", DTYPES)
corners = pytest.mark.parametrize("corner", CORNERS)


def pinhole(x: Array, y: Array, dtype: type) -> Array:
    """Unit vectors through points of the picture at distance 1."""
    d = AXES @ np.stack((x, y, np.ones_like(x)))
    return np.ascontiguousarray(d / np.linalg.norm(d, axis=0), dtype)


def picture_directions(n: int, dtype: type, seed: int) -> Array:
    return pinhole(*(2 * unit(2, n, np.float64, seed) - 1), dtype)


def at(corner: tuple[float, float], n: int, dtype: type) -> Array:
    """The direction of one place in the picture, n times."""
    return pinhole(*np.repeat(np.array(corner)[:, None], n, axis=1), dtype)


def on_plane(origins: Array, directions: Array, distance: float) -> Array:
    """Where rays meet the plane at that distance from the lens, (2, N) along right and up."""
    o = AXES.T @ (origins.astype(float) - ORIGIN[:, None])
    d = AXES.T @ directions.astype(float)
    return (o + d * ((distance - o[2]) / d[2]))[:2]


def rounding(dtype: type, distance: float) -> float:
    """What coordinates of points at that distance may be off by, in a picture of a right angle."""
    return 8 * float(np.finfo(dtype).eps) * (4 + math.sqrt(3) * distance)


# ---------------------------------------------------------------- the disk


@dtypes
def test_disk_points_stay_on_the_disk_for_the_worst_numbers(dtype: type) -> None:
    for u in (worst_units(2, dtype), np.array([[1, 0.5, 1], [0.5, 1, 1]], dtype)):
        radius = np.linalg.norm(point_on_disk(u), axis=0)
        assert (radius <= 1 + 2 * np.finfo(dtype).eps).all()


# ---------------------------------------------------------------- the pinhole within the lens


@pytest.mark.parametrize("d_dtype", DTYPES)
@pytest.mark.parametrize("p_dtype", DTYPES)
@pytest.mark.parametrize("focus_distance", [1e-6, 0.1, 1 / 3, 7.0, 1e6])
def test_the_lens_centre_gives_the_pinholes_rays(
    d_dtype: type, p_dtype: type, focus_distance: float
) -> None:
    directions = picture_directions(20_001, d_dtype, 2)
    points = np.zeros((2, 20_001), p_dtype)
    for zeros in (points, -points):
        origins, lens = lens_rays(
            **CAMERA,
            directions=frozen(directions),
            lens_points=zeros,
            focus_distance=focus_distance,
        )
        assert_pinhole(origins, lens, directions)
    # In one batch with others, and wherever they lie in memory.
    points = 0.1 * unit(2, 20_001, p_dtype, seed=3)
    points[:, ::3] = 0
    for layout in (np.ascontiguousarray, np.asfortranarray):
        origins, lens = lens_rays(
            **CAMERA,
            directions=layout(directions),
            lens_points=points,
            focus_distance=focus_distance,
        )
        assert_pinhole(origins[:, ::3], lens[:, ::3], directions[:, ::3])


def assert_pinhole(origins: Array, lens: Array, directions: Array) -> None:
    """The camera's origin, and the pinhole's directions, to within 4 units in the last place."""
    start = np.repeat(ORIGIN[:, None], origins.shape[1], axis=1).astype(origins.dtype)
    np.testing.assert_array_max_ulp(origins, start, 4)
    # Components next to 0 are as inexact as the largest.
    assert np.abs(lens - directions).max() <= 2 * np.finfo(directions.dtype).eps


@dtypes
def test_a_far_focus_leaves_every_direction_almost_as_it_is(dtype: type) -> None:
    directions = picture_directions(5000, dtype, 4)
    points = unit(2, 5000, dtype, seed=5) - dtype(0.5)
    origins, lens = lens_rays(
        **CAMERA, directions=directions, lens_points=points, focus_distance=1e6
    )
    # A lens of 0.7 across, seen from a million away.
    assert np.abs(lens - directions).max() <= 1e-6 + 2 * np.finfo(dtype).eps
    assert (origins != ORIGIN.astype(dtype)[:, None]).any(axis=0).all()


# ---------------------------------------------------------------- the lens


@dtypes
def test_rays_start_on_the_lens_where_they_are_told_to(dtype: type) -> None:
    points = unit(2, 1000, dtype, seed=6) - dtype(0.5)
    origins, _ = lens_rays(
        **CAMERA,
        directions=picture_directions(1000, dtype, 7),
        lens_points=points,
        focus_distance=3.0,
    )
    on_lens = AXES.T @ (origins.astype(float) - ORIGIN[:, None])
    assert np.abs(on_lens[:2] - points).max() < rounding(dtype, 1)
    assert np.abs(on_lens[2]).max() < rounding(dtype, 1)


@dtypes
@corners
@pytest.mark.parametrize("focus_distance", [0.5, 3.0, 100.0])
def test_the_plane_in_focus_is_sharp_at_the_pictures_corners_too(
    dtype: type, corner: tuple[float, float], focus_distance: float
) -> None:
    directions = at(corner, 1000, dtype)
    points = dtype(0.3) * point_on_disk(unit(2, 1000, dtype, seed=8))
    rays = lens_rays(
        **CAMERA, directions=directions, lens_points=points, focus_distance=focus_distance
    )
    assert_unit(rays[1], 1e-6)
    # A plane, not a sphere: the point in focus is as far along forward in the corner as in the middle.
    met = on_plane(*rays, focus_distance)
    sharp = np.array(corner)[:, None] * focus_distance
    assert np.abs(met - sharp).max() < rounding(dtype, focus_distance)


@dtypes
@pytest.mark.parametrize("focus_distance", [1e-6, 1e-3, 1.0, 1e3, 1e6])
def test_lens_rays_are_unit_length_for_the_worst_inputs(dtype: type, focus_distance: float) -> None:
    sizes = [0.0, 1e-6, 1e-3, 1.0, 1e3, 1e6]
    points = np.array([*product([s * x for x in sizes for s in (1, -1)], repeat=2)], dtype).T
    # From the middle of the picture to all but a right angle from it.
    slopes = np.array([0.0, 1.0, -30.0, 1e4, 1e6])
    d, p = every_pair(pinhole(slopes, -slopes / 3, dtype), points)
    for forward_facing in ((FORWARD @ d.astype(float)) > 0,):
        origins, lens = lens_rays(
            **CAMERA,
            directions=d[:, forward_facing],
            lens_points=p[:, forward_facing],
            focus_distance=focus_distance,
        )
        assert np.isfinite(origins).all()
        assert_unit(lens, 1e-6)


@pytest.mark.parametrize("wrong", [0, 0.0, -1.0, math.nan, -math.inf])
def test_a_focus_distance_out_of_range_is_refused(wrong: float) -> None:
    d, p = picture_directions(5, np.float32, 0), unit(2, 5)
    for call in (
        lambda: lens_rays(**CAMERA, directions=d, focus_distance=wrong, lens_points=p),
        lambda: circle_of_confusion(
            aperture_radius=0.25, focus_distance=wrong, depth=unit(1, 5)[0] + 1
        ),
    ):
        with pytest.raises(ValueError, match=f"^focus_distance must be > 0, got {wrong}$"):
            call()


# ---------------------------------------------------------------- the Gaussian lens formula


@pytest.mark.parametrize("f", [0.05, 1 / 3, 2.0, 1e-6, 1e3])
@pytest.mark.parametrize("ratio", [1e-3, 0.5, 1 - 1e-9, 1 + 1e-12, 1.5, 2.0, 1e3])
def test_image_distance_solves_the_lens_formula(f: float, ratio: float) -> None:
    d = f * ratio
    exact = 1 / (1 / Fraction(f) - 1 / Fraction(d))
    assert image_distance(f, d) == pytest.approx(float(exact), rel=1e-14)
    assert type(image_distance(f, d)) is float


def test_an_object_within_the_focal_length_has_a_virtual_image_behind_it() -> None:
    for near in (1 - 1e-15, 0.5, 1e-3, 1e-6):
        assert -math.inf < image_distance(1.0, near) <= -near


@pytest.mark.parametrize("scalar", [np.float32, np.float64, np.longdouble, np.array, int])
def test_image_distance_is_a_float_whatever_it_is_made_of(scalar: Any) -> None:
    assert image_distance(scalar(2), scalar(6)) == 3.0
    assert isinstance(image_distance(scalar(2), scalar(6)), float)
    assert isinstance(image_distance(scalar(2), scalar(2)), float)


@pytest.mark.parametrize("argument", ["focal_length", "object_distance"])
@pytest.mark.parametrize("wrong", [0, 0.0, -1.0, math.nan, -math.inf])
def test_lens_distances_out_of_range_are_refused(argument: str, wrong: float) -> None:
    given = {"focal_length": 1.0, "object_distance": 2.0, argument: wrong}
    with pytest.raises(ValueError, match=f"^{argument} must be > 0, got {wrong}$"):
        image_distance(**given)


# ---------------------------------------------------------------- the circle of confusion


@dtypes
@pytest.mark.parametrize("radius", [0.0, 0.01, 2.0])
@pytest.mark.parametrize("focus_distance", [0.5, 3.0, 1e6])
def test_circle_of_confusion_is_its_formula(
    dtype: type, radius: float, focus_distance: float
) -> None:
    depth = np.geomspace(1e-6, 1e6, 1000).astype(dtype)
    exact = 2 * radius * np.abs(focus_distance - depth.astype(float)) / depth
    found = circle_of_confusion(depth, radius, focus_distance)
    assert found == pytest.approx(exact, rel=8 * float(np.finfo(dtype).eps), abs=0)
    assert circle_of_confusion(np.array([focus_distance], dtype), radius, focus_distance) == [0]


@dtypes
def test_circle_of_confusion_is_finite_for_the_worst_inputs(dtype: type) -> None:
    sizes = [1e-6, 1e-3, 1.0, 1e3, 1e6]
    depth = np.array(sizes, dtype)
    for radius, focus_distance in product([0.0, *sizes], sizes):
        diameter = circle_of_confusion(depth, radius, focus_distance)
        assert diameter.dtype == dtype
        assert np.isfinite(diameter).all()
        assert (diameter >= 0).all()
        assert radius > 0 or (diameter == 0).all()


@pytest.mark.parametrize("wrong", [-1.0, -1e-45, math.nan, -math.inf])
def test_an_aperture_out_of_range_is_refused(wrong: float) -> None:
    with pytest.raises(ValueError, match=f"^aperture_radius must be >= 0, got {wrong}$"):
        circle_of_confusion(np.ones(3, np.float32), wrong, 1.0)


@pytest.mark.parametrize("wrong", [0.0, -1.0, math.nan, -math.inf])
def test_one_depth_out_of_range_is_enough(wrong: float) -> None:
    with pytest.raises(ValueError, match=f"^depth must be > 0, got {wrong}$"):
        circle_of_confusion(np.array([1, wrong, 2], np.float32), 0.1, 1.0)
