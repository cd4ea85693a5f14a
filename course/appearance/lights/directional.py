"""A light infinitely far away."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from course.appearance.lights.sample import Sample
from course.core.types import Floats32

_ONE = np.ones(1, np.float32)


@dataclass(frozen=True)
class DirectionalLight:
    """Irradiance [W/m^2] from one direction; ``towards`` (3,) is the unit vector to the light."""

    name: str
    towards: Floats32
    color: Floats32
    width: int = 0
    velocity: Floats32 | None = None
    limit: float = 1e30

    def sample(self, points: Floats32, u: Floats32 | None, compiled: bool = False) -> Sample:
        """See ``course.appearance.lights``."""
        return Sample(self.towards[:, None], _ONE, _ONE)
