"""A light without extent."""

from __future__ import annotations

from dataclasses import dataclass

from course.appearance.lights.sample import TO_A_POINT, Sample, inverse_square
from course.core.types import Floats32


@dataclass(frozen=True)
class PointLight:
    """Intensity I [W/sr] at one place: E = I cos / d^2."""

    name: str
    position: Floats32
    color: Floats32
    width: int = 0
    limit: float = TO_A_POINT

    def sample(self, points: Floats32, u: Floats32 | None) -> Sample:
        """See ``course.appearance.lights``."""
        to_light = self.position[:, None] - points
        inverse_length, inverse_squared = inverse_square(to_light)
        return Sample(to_light, inverse_length, inverse_squared)
