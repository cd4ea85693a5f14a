"""Environments: the radiance of rays that hit nothing, constant or from a cube map."""

from dataclasses import dataclass

from course.engine.core.types import Floats32, Functions


@dataclass(frozen=True)
class ConstantEnvironment:
    """The same radiance ``color``, (3,) float32, from all directions."""

    color: Floats32

    def radiance(self, direction: Floats32) -> Floats32:
        """Radiance (3, 1) [W/(m^2 sr)] from directions (3, n)."""
        return self.color[:, None]


@dataclass(frozen=True)
class CubeEnvironment:
    """A cube map; ``seamless`` is true to interpolate across the cube's edges.

    ``faces`` are (6, S, S, 3) float32 linear radiance, rows from the top.
    """

    faces: Floats32
    cube_map: Functions
    seamless: bool

    def radiance(self, direction: Floats32) -> Floats32:
        """Radiance (3, n) [W/(m^2 sr)] from directions (3, n)."""
        radiance: Floats32
        if self.seamless:
            radiance = self.cube_map.lookup_seamless(self.faces, direction)
        else:
            radiance = self.cube_map.lookup(self.faces, direction)
        return radiance


Environment = ConstantEnvironment | CubeEnvironment
