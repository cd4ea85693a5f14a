"""The pinhole camera: rays through points of the picture.

Picture coordinates are in pixels, x to the right and y down from the upper left corner; the middle of the picture is
on the axis, and pixels are square.
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
    """

    origin: Floats32
    right: Floats32
    up: Floats32
    forward: Floats32
    corner: Floats32
    step_x: Floats32
    step_y: Floats32

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


def make_camera(
    eye: Floats64, view: Floats64, up: Floats64, vertical_fov: float, width: int, height: int
) -> Camera:
    """A camera from where it is and which way it looks.

    Parameters
    ----------
    eye, view, up : (3,) float64; the view of any length, up any vector not parallel to it
    vertical_fov : radians
    width, height : pixels
    """
    forward = _unit(view)
    right = _unit(np.cross(forward, _unit(up)))
    true_up = np.cross(right, forward)
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
    )


def _unit(vector: Floats64) -> Floats64:
    # Scaled by a power of two before the squares, which changes no digit: they neither overflow nor vanish.
    _, exponent = np.frexp(np.abs(vector).max())
    scaled: Floats64 = np.ldexp(vector, -exponent)
    scaled /= np.linalg.norm(scaled)
    return scaled
