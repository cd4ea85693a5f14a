"""Lights without extent: at a point, or infinitely far away."""

from dataclasses import dataclass

import numpy as np

from course.engine.core.lights.sample import TO_THE_LIGHT, FlatLight, Light, Sample
from course.engine.core.types import Floats32, Floats64


@dataclass(frozen=True)
class PointLight(FlatLight):
    """Intensity I [W/sr] at a point: E = I cos / d^2. ``color`` is I / pi.

    With a normal the light stands for a cell of an emitting ``RectangleLight``, and I is multiplied by the emitter's
    cosine. ``blockable`` is true if it is also blocked by a surface that it lies on.
    """

    name: str
    position: Floats32
    color: Floats32
    normal: Floats64 | None = None
    width: int = 0
    velocity: Floats32 | None = None
    two_sided: bool = False
    visible: bool = True
    blockable: bool = False

    @property
    def limit(self) -> float:
        """See ``Light``."""
        return TO_THE_LIGHT if self.blockable else super().limit

    def sample(self, points: Floats32, u: Floats32 | None) -> Sample:
        """See ``Light``."""
        place = self.position[:, None]
        return self.from_point(place, points, place)


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

    def sample(self, points: Floats32, u: Floats32 | None) -> Sample:
        """See ``Light``."""
        return Sample(self.to_light[:, None], _ONE, _ONE)
