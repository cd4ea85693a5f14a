"""Environments: the radiance of rays that hit nothing, constant or from a cube map."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from course.core.functions import Functions
from course.core.types import Floats32


class Environment(Protocol):
    """Radiance by direction."""

    @property
    def black(self) -> bool:
        """True if the radiance is 0 in all directions."""

    def radiance(self, direction: Floats32) -> Floats32:
        """(3, n) or (3, 1) radiance [W/(m^2 sr)] from directions (3, n)."""


@dataclass(frozen=True)
class ConstantEnvironment:
    """The same radiance ``color``, (3,) float32, from all directions."""

    color: Floats32

    @property
    def black(self) -> bool:
        """See ``Environment``."""
        return not self.color.any()

    def radiance(self, direction: Floats32) -> Floats32:
        """See ``Environment``."""
        return self.color[:, None]


@dataclass(frozen=True)
class CubeEnvironment:
    """A cube map; ``seamless`` is true to interpolate across the cube's edges.

    ``faces`` are (6, S, S, 3) float32 linear radiance, rows from the top.
    """

    faces: Floats32
    cube_map: Functions
    seamless: bool

    @property
    def black(self) -> bool:
        """See ``Environment``."""
        return not self.faces.any()

    def radiance(self, direction: Floats32) -> Floats32:
        """See ``Environment``."""
        radiance: Floats32
        if self.seamless:
            radiance = self.cube_map.lookup_seamless(self.faces, direction)
        else:
            radiance = self.cube_map.lookup(self.faces, direction)
        return radiance
