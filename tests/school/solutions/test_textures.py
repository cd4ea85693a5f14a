"""Textures: places all over a sphere, and the colours of a repeated picture."""

import numpy as np
import pytest

from course.school.grading.checks.laws import DTYPES
from tests.school.solutions.contract import SOLUTIONS, directions, frozen, unit, worst_directions

sphere_uv = SOLUTIONS.function("textures", "sphere_uv")
texture_lookup = SOLUTIONS.function("textures", "texture_lookup")

IMAGE = np.random.default_rng(0).random((4, 7, 3))


dtypes = pytest.mark.parametrize("dtype", DTYPES)


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
