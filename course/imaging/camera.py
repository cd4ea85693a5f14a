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
    corner : (3,) float64, direction to the picture's upper left corner, forward component 1
    step_x, step_y : (3,) float64, how far the direction moves from pixel to pixel
    """

    origin: Floats32
    right: Floats32
    up: Floats32
    forward: Floats32
    corner: Floats64
    step_x: Floats64
    step_y: Floats64

    def directions(self, x: Floats32, y: Floats32) -> Floats32:
        """Unit directions through picture points.

        Parameters
        ----------
        x, y : (N,) float32 [pixels]

        Returns
        -------
        (3, N) float32
        """
        corner, step_x, step_y = (
            a.astype(np.float32) for a in (self.corner, self.step_x, self.step_y)
        )
        direction = np.empty((3, len(x)), np.float32)
        for row in range(3):
            np.multiply(x, step_x[row], out=direction[row])
            direction[row] += corner[row]
            direction[row] += y * step_y[row]
        length = dot(direction, direction)
        np.sqrt(length, out=length)
        np.divide(np.float32(1), length, out=length)
        direction *= length
        return direction


def make_camera(
    eye: Floats64, look_at: Floats64, up: Floats64, vertical_fov: float, width: int, height: int
) -> Camera:
    """A camera from where it is and what it looks at.

    Parameters
    ----------
    eye, look_at, up : (3,) float64; up is any vector not parallel to the view
    vertical_fov : radians
    width, height : pixels
    """
    forward = (look_at - eye) / np.linalg.norm(look_at - eye)
    right = np.cross(forward, up)
    right /= np.linalg.norm(right)
    true_up = np.cross(right, forward)
    half_height = np.tan(vertical_fov / 2)
    pixel = 2 * half_height / height
    corner = forward - right * (pixel * width / 2) + true_up * half_height
    return Camera(
        *(a.astype(np.float32) for a in (eye, right, true_up, forward)),
        corner=corner,
        step_x=right * pixel,
        step_y=-true_up * pixel,
    )
