"""The camera: rays through points of the picture, from a pinhole or a thin lens.

Picture coordinates are in pixels, x to the right and y down from the upper left corner.
"""

from dataclasses import dataclass

import numpy as np

from course.engine.core.types import Floats32, Functions
from course.engine.core.vectors import dot


@dataclass(frozen=True)
class Lens:
    """A thin lens with a round aperture; radius and distance [unit of the compiled scene]."""

    aperture_radius: float
    focus_distance: float
    thin_lens: Functions

    def points(self, u: Floats32) -> Floats32:
        """Uniform points (2, N) on an aperture of radius 1, from u (2, N) in [0, 1)."""
        on_disk: Floats32 = self.thin_lens.point_on_disk(u)
        return on_disk


@dataclass(frozen=True)
class Camera:
    """A camera in the compiled scene.

    Attributes
    ----------
    origin : (3,) float32
    right, up, forward : (3,) float32, an orthonormal basis
    corner : (3,) float32, direction to the upper left corner of the picture; its forward component is 1
    step_x, step_y : (3,) float32, change of direction per pixel
    lens : None for a pinhole
    """

    origin: Floats32
    right: Floats32
    up: Floats32
    forward: Floats32
    corner: Floats32
    step_x: Floats32
    step_y: Floats32
    lens: Lens | None = None

    def rays(
        self, x: Floats32, y: Floats32, u: Floats32 | None, moved: Floats32 | None
    ) -> tuple[Floats32, Floats32]:
        """Origins (3, N) or (3, 1), and unit directions (3, N).

        Parameters
        ----------
        x, y : (N,) float32 [pixels]
        u : (2, N) float32 in [0, 1), for the point on the lens; None for a pinhole
        moved : (3, N) float32, displacement of the camera; None if it stands still
        """
        origin, direction = self.origin[:, None], self.directions(x, y)
        if self.lens is not None and u is not None:
            points = self.lens.points(u)
            points *= np.float32(self.lens.aperture_radius)
            axes = self.right, self.up, self.forward
            origin, direction = self.lens.thin_lens.lens_rays(
                self.origin, *axes, direction, points, self.lens.focus_distance
            )
        if moved is not None:
            origin = origin + moved
        return origin, direction

    def directions(self, x: Floats32, y: Floats32) -> Floats32:
        """Unit directions (3, N) float32 through picture points x, y (N,) float32 [pixels]."""
        direction = self.step_x[:, None] * x
        direction += self.corner[:, None]
        direction += self.step_y[:, None] * y
        length = np.sqrt(dot(direction, direction))
        direction *= np.divide(np.float32(1), length, out=length)
        return direction
