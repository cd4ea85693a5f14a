"""Apertures that are not round."""

import math
from dataclasses import dataclass

import numpy as np

from course.engine.core.camera import Lens
from course.engine.core.types import Floats32


@dataclass(frozen=True)
class PolygonLens(Lens):
    """A lens whose aperture is a regular polygon with ``blades`` corners."""

    blades: int

    def points(self, u: Floats32) -> Floats32:
        """See ``Lens``."""
        return point_on_polygon(u, self.blades)


@dataclass(frozen=True)
class SquareLens(Lens):
    """A lens whose aperture is the square around the circle of ``aperture_radius``."""

    def points(self, u: Floats32) -> Floats32:
        """See ``Lens``."""
        return 2 * u - 1


def point_on_polygon(u: Floats32, corners: int) -> Floats32:
    """Uniform points (2, N) on the regular polygon inscribed in the unit circle, from u (2, N) in [0, 1).

    The integer part of u[0] * corners chooses one of the triangles around the centre. The fraction chooses a point on
    the triangle's outer edge, and sqrt(u[1]) scales that point towards the centre.
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
