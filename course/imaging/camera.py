"""The pinhole camera: rays through points of the picture.

Picture coordinates are in pixels, x to the right and y down from the upper left corner. Seen through a field of view,
the middle of the picture is on the axis, and pixels are square; a window may lie anywhere, and stretch them.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from course.core.types import Floats32, Floats64
from course.core.vectors import dot


@dataclass(frozen=True)
class Camera:
    """A camera in the compiled scene.

    Attributes
    ----------
    origin : (3,) float32
    right, up, forward : (3,) float32, an orthonormal basis
    corner : (3,) float32, direction to the picture's upper left corner, forward component 1
    step_x, step_y : (3,) float32, how far the direction moves from pixel to pixel
    near : depth along forward at which rays begin
    """

    origin: Floats32
    right: Floats32
    up: Floats32
    forward: Floats32
    corner: Floats32
    step_x: Floats32
    step_y: Floats32
    near: float = 0.0

    def directions(self, x: Floats32, y: Floats32) -> Floats32:
        """Unit directions through picture points.

        Parameters
        ----------
        x, y : (N,) float32 [pixels]

        Returns
        -------
        (3, N) float32
        """
        direction = self.step_x[:, None] * x
        direction += self.corner[:, None]
        direction += self.step_y[:, None] * y
        length = np.sqrt(dot(direction, direction))
        direction *= np.divide(np.float32(1), length, out=length)
        return direction

    def from_near_plane(self, origin: Floats32, direction: Floats32) -> Floats32:
        """Where rays pass the near plane, (3, N) float32.

        Parameters
        ----------
        origin : (3, N) or (3, 1) float32, at depth 0
        direction : (3, N) float32, forwards
        """
        return origin + direction * self.way_to_near_plane(direction)

    def way_to_near_plane(self, direction: Floats32) -> Floats32:
        """How far it is along rays (3, N) from depth 0, (N,) float32."""
        # The widest fields of view have rays that go forwards by less than float32 can tell.
        forwards = np.maximum(dot(self.forward[:, None], direction), np.float32(1e-12))
        way: Floats32 = np.divide(np.float32(self.near), forwards)
        return way


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
