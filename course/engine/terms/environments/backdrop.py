"""A picture behind everything that the camera sees: it fills the window, and moves and turns with the camera.

It lies infinitely far away, so a lens blurs it unless what is far is in focus.
"""

from dataclasses import dataclass, replace

import numpy as np

from course.engine.core.camera import Camera
from course.engine.core.types import Floats32
from course.engine.core.vectors import dot
from course.engine.terms.surfaces.textures import Texture

LEAST = np.finfo(np.float64).tiny
"""Divided by instead of 0: a view so narrow that float32 has no steps in it sees one place of the picture."""


@dataclass(frozen=True)
class Backdrop:
    """The environment of camera rays, of which no other ray knows.

    Attributes
    ----------
    picture : linear, looked up by u to the right and v upwards
    scale : (3,) float32, radiance of white
    camera : the one that it is seen by, and the size of its picture [pixels]; None before that is known
    """

    picture: Texture
    scale: Floats32
    camera: tuple[Camera, int, int] | None = None

    def before(self, camera: Camera, width: int, height: int) -> "Backdrop":
        """The same for one camera."""
        return replace(self, camera=(camera, width, height))

    def radiance(self, direction: Floats32) -> Floats32:
        """Radiance (3, n) [W/(m^2 sr)] from directions (3, n)."""
        assert self.camera is not None
        camera, width, height = self.camera
        # Where the window at distance 1 is passed; a lens may send rays past it. In double precision, for steps of a
        # narrow view have no squares in single precision.
        forwards = np.maximum(dot(camera.forward[:, None], direction), np.float32(1e-12))
        place = direction / forwards.astype(np.float64) - camera.corner[:, None]
        x, y = (
            dot(step[:, None], place) / max((step * step).sum() * size, LEAST)
            for step, size in (
                (camera.step_x.astype(np.float64), width),
                (camera.step_y.astype(np.float64), height),
            )
        )
        image = self.picture.image
        size = np.array(image.shape[1::-1], np.float32)[:, None]
        if self.picture.nearest:
            column, row = np.clip(np.floor(np.stack((x, y)) * size), 0, size - 1).astype(np.intp)
            shown: Floats32 = image[row, column].T
        else:
            # Nothing of the other edge is mixed in.
            uv = np.clip(np.stack((x, 1 - y)), 0.5 / size, 1 - 0.5 / size)
            shown = self.picture(uv.astype(np.float32))
        return shown * self.scale[:, None]
