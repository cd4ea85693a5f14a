"""Cameras from where they are and which way they look."""

from __future__ import annotations

import numpy as np

from course.core.camera import Camera
from course.core.types import Floats64


def make_camera(
    eye: Floats64,
    view: Floats64,
    up: Floats64,
    vertical_fov: float,
    width: int,
    height: int,
    near: float = 0.0,
) -> Camera:
    """A camera from where it is and which way it looks.

    Parameters
    ----------
    eye, view, up : (3,) float64; the view of any length, up any vector not parallel to it
    vertical_fov : radians
    width, height : pixels
    near : depth at which rays begin
    """
    forward, right, true_up = _axes(view, up)
    half_height = np.tan(vertical_fov / 2)
    pixel = 2 * half_height / height
    corner = forward - right * (pixel * width / 2) + true_up * half_height
    return Camera(
        origin=eye.astype(np.float32),
        right=right.astype(np.float32),
        up=true_up.astype(np.float32),
        forward=forward.astype(np.float32),
        corner=corner.astype(np.float32),
        step_x=(right * pixel).astype(np.float32),
        step_y=(-true_up * pixel).astype(np.float32),
        near=near,
    )


def make_window_camera(
    eye: Floats64,
    view: Floats64,
    up: Floats64,
    edges: Floats64,
    width: int,
    height: int,
    near: float = 0.0,
) -> Camera:
    """A camera whose picture is a window at right angles to the view; see ``make_camera``.

    Parameters
    ----------
    edges : (4,) float64, where the window's left, right, lower and upper edges are, at distance 1 and from the axis
    """
    forward, right, true_up = _axes(view, up)
    left, right_edge, bottom, top = edges
    return Camera(
        origin=eye.astype(np.float32),
        right=right.astype(np.float32),
        up=true_up.astype(np.float32),
        forward=forward.astype(np.float32),
        corner=(forward + right * left + true_up * top).astype(np.float32),
        step_x=(right * ((right_edge - left) / width)).astype(np.float32),
        step_y=(true_up * ((bottom - top) / height)).astype(np.float32),
        near=near,
    )


def _axes(view: Floats64, up: Floats64) -> tuple[Floats64, Floats64, Floats64]:
    """Unit vectors forward, to the right and up."""
    forward = _unit(view)
    right = _unit(np.cross(forward, _unit(up)))
    return forward, right, np.cross(right, forward)


def _unit(vector: Floats64) -> Floats64:
    # Scaled by a power of two before the squares, which changes no digit: they neither overflow nor vanish.
    _, exponent = np.frexp(np.abs(vector).max())
    scaled: Floats64 = np.ldexp(vector, -exponent)
    scaled /= np.linalg.norm(scaled)
    return scaled
