"""The thin lens: camera rays from points of the aperture, through the `thin_lens` module."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from course.core.types import Floats32
from course.imaging.camera import Camera

LensRays = Callable[..., tuple[Floats32, Floats32]]
PointOnDisk = Callable[[Floats32], Floats32]


@dataclass(frozen=True)
class Lens:
    """An aperture in focus on a plane.

    Attributes
    ----------
    aperture_radius, focus_distance : in the unit of the compiled scene
    shape : "disk", "square" or "polygon"
    blades : corners of the polygon
    point_on_disk : the function that places points on a disk, None for another shape
    lens_rays : the function of the thin_lens module
    """

    aperture_radius: float
    focus_distance: float
    shape: str
    blades: int
    point_on_disk: PointOnDisk | None
    lens_rays: LensRays

    def rays(
        self, camera: Camera, origin: Floats32, directions: Floats32, u: Floats32
    ) -> tuple[Floats32, Floats32]:
        """Origins and directions (3, N) of rays that leave the lens.

        Parameters
        ----------
        origin : (3,) centre of the lens
        directions : (3, N) of the pinhole rays
        u : (2, N)
        """
        points = self._points(u)
        points *= np.float32(self.aperture_radius)
        return self.lens_rays(
            origin,
            camera.right,
            camera.up,
            camera.forward,
            directions,
            points,
            self.focus_distance,
        )

    def _points(self, u: Floats32) -> Floats32:
        """Uniform points of an aperture of radius 1."""
        if self.point_on_disk is not None:
            return self.point_on_disk(u)
        if self.shape == "square":
            return 2 * u - 1
        return point_on_polygon(u, self.blades)


def point_on_polygon(u: Floats32, corners: int) -> Floats32:
    """Uniform points of the regular polygon inscribed in the unit circle, (2, N).

    The first number chooses one of the equal triangles around the centre and, what is left of it, a place along the
    triangle's outer edge; the square root of the second one is the distance from the centre.
    """
    scaled = u[0] * np.float32(corners)
    number = np.minimum(np.floor(scaled), np.float32(corners - 1))
    along = scaled - number
    angle = number * np.float32(2 * math.pi / corners)
    step = np.float32(2 * math.pi / corners)
    x = (1 - along) * np.cos(angle) + along * np.cos(angle + step)
    y = (1 - along) * np.sin(angle) + along * np.sin(angle + step)
    points: Floats32 = np.stack((x, y))
    points *= np.sqrt(u[1])
    return points
