"""Depth of field: rays at any angle through lenses of any size, and the lens formula in exact fractions."""

from fractions import Fraction
from itertools import product
from typing import Any

import numpy as np
import pytest

from course.school.grading.checks.laws import DTYPES
from tests.school.solutions.contract import SOLUTIONS, Array, assert_unit, every_pair

lens_rays = SOLUTIONS.function("thin_lens", "lens_rays")
image_distance = SOLUTIONS.function("thin_lens", "image_distance")


ORIGIN = np.array((0.3, -1.7, 2.1))
# A camera that looks along no axis.
RIGHT, UP, FORWARD = np.array([(2, -1, 2), (2, 2, -1), (-1, 2, 2)]) / 3
CAMERA = {"origin": ORIGIN, "right": RIGHT, "up": UP, "forward": FORWARD}
AXES = np.array([RIGHT, UP, FORWARD]).T


dtypes = pytest.mark.parametrize("dtype", DTYPES)


def pinhole(x: Array, y: Array, dtype: type) -> Array:
    """Unit vectors through points of the picture at distance 1."""
    d = AXES @ np.stack((x, y, np.ones_like(x)))
    return np.ascontiguousarray(d / np.linalg.norm(d, axis=0), dtype)


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


@pytest.mark.parametrize("f", [0.05, 1 / 3, 2.0, 1e-6, 1e3])
@pytest.mark.parametrize("ratio", [1e-3, 0.5, 1 - 1e-9, 1 + 1e-12, 1.5, 2.0, 1e3])
def test_image_distance_solves_the_lens_formula(f: float, ratio: float) -> None:
    d = f * ratio
    exact = 1 / (1 / Fraction(f) - 1 / Fraction(d))
    assert image_distance(f, d) == pytest.approx(float(exact), rel=1e-14)
    assert type(image_distance(f, d)) is float


@pytest.mark.parametrize("scalar", [np.float32, np.float64, np.longdouble, np.array, int])
def test_image_distance_is_a_float_whatever_it_is_made_of(scalar: Any) -> None:
    assert image_distance(scalar(2), scalar(6)) == 3.0
    assert isinstance(image_distance(scalar(2), scalar(6)), float)
    assert isinstance(image_distance(scalar(2), scalar(2)), float)
