"""A point light that shines into a cone, with a soft edge.

The share of the intensity falls from 1 at the inner angle to 0 at the outer one, as the fourth power of a line in the
cosine (the lecture's, and that of Pharr, Jakob and Humphreys, "Physically Based Rendering", third edition, 12.3.1).
"""

import math
from dataclasses import dataclass

import numpy as np

from course.engine.core.lights.point import PointLight
from course.engine.core.lights.sample import Sample
from course.engine.core.lights.sample import towards as towards_in_numpy
from course.engine.core.types import Floats32
from course.engine.core.vectors import dot


@dataclass(frozen=True, kw_only=True)
class SpotLight(PointLight):
    """Intensity I [W/sr] within a cone, less around it, and 0 outside of a wider one.

    Attributes
    ----------
    axis : (3,) float32 unit, the way along the middle of the cones
    inner, outer : angles [rad] between the axis and the cones, 0 <= inner <= outer <= pi
    """

    axis: Floats32
    inner: float
    outer: float

    @property
    def lit_cone(self) -> tuple[Floats32, float]:
        """Axis and outer angle [rad] of all that it lights."""
        return self.axis, self.outer

    @property
    def falloff(self) -> tuple[float, float]:
        """1 - cos of the outer angle, and over how much of it the light falls off."""
        outer = _versine(self.outer)
        return outer, max(outer - _versine(self.inner), SHARPEST * outer, LEAST)

    def sample(self, points: Floats32, u: Floats32 | None) -> Sample:
        """See ``Light``."""
        sample = towards_in_numpy(self.position[:, None], points)
        # 1 - cos of an angle is half the square of the chord, which keeps its digits where the angle is small.
        chord = -sample.to_light * sample.inverse_length - self.axis[:, None]
        outer, edge = self.falloff
        share = np.clip((outer - dot(chord, chord) / 2) / np.float32(edge), 0, 1)
        share *= share
        factor = sample.factor * (share * share)
        return Sample(sample.to_light, sample.inverse_length, np.asarray(factor, np.float32))

    @property
    def solid_angle(self) -> float:
        """Integral of the share over all directions [sr]: of the inner cone, and a fifth of what lies around it."""
        inner, outer = _versine(self.inner), _versine(self.outer)
        return 2 * math.pi * (inner + (outer - inner) / 5)


SHARPEST = 1e-7
"""Part of the outer cone's 1 - cos over which a light falls off at least: float32 carries no sharper edge."""

LEAST = 1e-30
"""1 - cos that is divided by at least."""


def _versine(angle: float) -> float:
    """1 - cos."""
    return 2 * math.sin(angle / 2) ** 2
