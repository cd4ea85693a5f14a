"""Lights without extent: at a point, or infinitely far away."""

from dataclasses import dataclass

import numpy as np

from course.core.lights.sample import TO_A_POINT, TO_A_SURFACE, TO_THE_LIGHT, Light, Sample, Towards
from course.core.types import Floats32


@dataclass(frozen=True)
class PointLight(Light):
    """Intensity I [W/sr] at a point: E = I cos / d^2. ``color`` is I / pi.

    Attributes
    ----------
    normal : (3,) float32 unit, if the light stands for a cell of an emitting ``RectangleLight``; I is then multiplied
        by the emitter's cosine
    two_sided, visible : as in ``RectangleLight``, for such a cell
    blockable : true if the light is also blocked by a surface that it lies on
    """

    name: str
    position: Floats32
    color: Floats32
    normal: Floats32 | None = None
    width: int = 0
    velocity: Floats32 | None = None
    two_sided: bool = False
    visible: bool = True
    blockable: bool = False

    @property
    def limit(self) -> float:
        """See ``Light``."""
        if self.blockable:
            return TO_THE_LIGHT
        return TO_A_SURFACE if self.normal is not None and self.visible else TO_A_POINT

    def sample(self, points: Floats32, u: Floats32 | None, towards: Towards) -> Sample:
        """See ``Light``."""
        return towards(self.position[:, None], points, self.normal, self.two_sided)


_ONE = np.ones(1, np.float32)


@dataclass(frozen=True)
class DirectionalLight(Light):
    """From one direction; ``to_light`` (3,) is the unit vector to the light, ``color`` irradiance / pi [W/m^2]."""

    name: str
    to_light: Floats32
    color: Floats32
    width: int = 0
    velocity: Floats32 | None = None
    limit: float = 1e30

    def sample(self, points: Floats32, u: Floats32 | None, towards: Towards) -> Sample:
        """See ``Light``."""
        return Sample(self.to_light[:, None], _ONE, _ONE)
