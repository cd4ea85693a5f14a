"""Area lights: where they have no extent, next to a sphere's poles, and disks that face points anywhere."""

import numpy as np
import pytest

from course.school.grading.checks.laws import DTYPES
from tests.school.solutions.contract import SOLUTIONS, unit, worst_units

point_on_rectangle = SOLUTIONS.function("soft_shadows", "point_on_rectangle")
point_on_sphere = SOLUTIONS.function("soft_shadows", "point_on_sphere")
point_on_facing_disk = SOLUTIONS.function("soft_shadows", "point_on_facing_disk")

ORIGIN = np.zeros(3)

dtypes = pytest.mark.parametrize("dtype", DTYPES)


def test_a_rectangle_without_extent_is_its_corner() -> None:
    corner = np.array((1.0, -2.0, 0.5), np.float32) / 3
    points = point_on_rectangle(corner, ORIGIN, ORIGIN, unit(2, 100))
    np.testing.assert_array_max_ulp(points, np.repeat(corner[:, None], 100, axis=1), 4)


@dtypes
def test_sphere_points_lie_on_the_sphere_next_to_its_poles_too(dtype: type) -> None:
    near = dtype(2) ** -np.arange(60, dtype=dtype)
    ends = np.concatenate((near, 1 - near, worst_units(1, dtype)[0]))
    u = np.stack([x.ravel() for x in np.meshgrid(ends, ends)])
    points = point_on_sphere(ORIGIN, 1, u)
    assert np.abs(np.linalg.norm(points, axis=0) - 1).max() < 4 * np.finfo(dtype).eps


@dtypes
def test_the_disk_is_finite_wherever_the_point_is(dtype: type) -> None:
    sizes = [0.0, 1e-6, 1e-3, 1.0, 1e3, 1e6]
    ends = [sign * size for size in sizes for sign in (1, -1)]
    points = np.array(np.meshgrid(ends, ends, ends), dtype).reshape(3, -1)
    u = unit(2, points.shape[1], dtype)
    for center in (0.0, 1e-6, -1.0, 1e6, -1e6):
        disk = point_on_facing_disk(np.array((center, 0, -center)), 1.0, points, u)
        assert np.isfinite(disk).all()
