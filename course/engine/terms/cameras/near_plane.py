"""A camera with a near plane: it sees nothing that is nearer along its view."""

from dataclasses import dataclass

import numpy as np

from course.engine.core.camera import Camera
from course.engine.core.types import Floats32
from course.engine.core.vectors import dot


@dataclass(frozen=True)
class NearPlaneCamera(Camera):
    """A camera whose rays start at the plane at depth ``near`` along forward [unit of the compiled scene]."""

    near: float = 0.0

    def rays(
        self, x: Floats32, y: Floats32, u: Floats32 | None, moved: Floats32 | None
    ) -> tuple[Floats32, Floats32]:
        """See ``Camera``."""
        origin, direction = super().rays(x, y, u, moved)
        return origin + direction * self.distance_to_plane(direction), direction

    def distance_to_plane(self, direction: Floats32) -> Floats32:
        """Distance (N,) float32 along unit directions (3, N) from the pinhole to the plane."""
        # In the widest fields of view the forward component can round to 0.
        forwards = np.maximum(dot(self.forward[:, None], direction), np.float32(1e-12))
        distance: Floats32 = np.divide(np.float32(self.near), forwards)
        return distance
