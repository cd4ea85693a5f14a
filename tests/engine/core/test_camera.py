"""The camera: where its rays go, worked out by hand."""

import math

import numpy as np
import pytest

from course.engine.core.camera import Camera
from course.engine.scene.building.cameras import make_camera

UP = np.array([0.0, 1.0, 0.0])


def camera(width: int = 64, height: int = 48, fov: float = math.radians(40)) -> Camera:
    return make_camera(
        np.array([1.0, 2.0, 5.0]), np.array([-1.0, -1.5, -6.0]), UP, fov, width, height
    )


def through(one: Camera, x: float, y: float) -> np.ndarray:
    f = np.float32
    return one.directions(np.array([x], f), np.array([y], f))[:, 0].astype(float)


def test_the_middle_of_the_picture_looks_at_the_target() -> None:
    forward = np.array([-1.0, -1.5, -6.0])
    assert np.allclose(through(camera(), 32, 24), forward / np.linalg.norm(forward), atol=2e-7)


def test_the_basis_is_orthonormal_and_right_handed() -> None:
    one = camera()
    basis = np.stack((one.right, one.up, one.forward)).astype(float)
    assert np.allclose(basis @ basis.T, np.eye(3), atol=3e-7)
    assert np.allclose(np.cross(basis[0], basis[1]), -basis[2], atol=3e-7)
    assert one.right[1] == 0, "the horizon is level"
    assert one.up[1] > 0


@pytest.mark.parametrize("degrees", [1.0, 40.0, 90.0, 170.0])
def test_the_field_of_view_reaches_from_the_lower_to_the_upper_edge(degrees: float) -> None:
    one = camera(fov=math.radians(degrees))
    top, bottom = through(one, 32, 0), through(one, 32, 48)
    angle = math.atan2(np.linalg.norm(np.cross(top, bottom)), top @ bottom)
    assert math.isclose(angle, math.radians(degrees), rel_tol=1e-5)
    assert top @ one.up > 0 > bottom @ one.up


@pytest.mark.parametrize(("width", "height"), [(64, 48), (48, 64), (1, 1), (301, 7)])
def test_pixels_are_square_and_the_picture_is_not_mirrored(width: int, height: int) -> None:
    one = camera(width, height)
    forward, right, up = (a.astype(float) for a in (one.forward, one.right, one.up))

    def plane(x: float, y: float) -> np.ndarray:
        d = through(one, x, y)
        return np.array([d @ right, d @ up]) / (d @ forward)

    pixel = 2 * math.tan(math.radians(20)) / height
    corner = plane(0, 0)
    assert np.allclose(corner, [-pixel * width / 2, pixel * height / 2], atol=1e-6)
    assert np.allclose(plane(1, 0) - corner, [pixel, 0], atol=1e-6)
    assert np.allclose(plane(0, 1) - corner, [0, -pixel], atol=1e-6)


def test_directions_have_unit_length() -> None:
    rng = np.random.default_rng(0)
    x, y = (rng.random((2, 10000)) * [[64], [48]]).astype(np.float32)
    for degrees in (1e-3, 40, 179.9):
        directions = camera(fov=math.radians(degrees)).directions(x, y)
        assert directions.dtype == np.float32
        assert np.abs(np.linalg.norm(directions.astype(float), axis=0) - 1).max() < 3e-7


@pytest.mark.parametrize("k", [2.0**40, 2.0**1020, 2.0**-1020])
def test_the_lengths_of_up_and_of_the_view_do_not_matter(k: float) -> None:
    eye, view = np.array([1.0, 2.0, 5.0]), np.array([-1.0, -2.0, -5.0])
    a, b = (make_camera(eye, view * k, UP * k, 0.7, 8, 6) for k in (1.0, k))
    assert np.array_equal(a.corner, b.corner)
    assert np.array_equal(a.step_x, b.step_x)
