"""A light without extent."""

from __future__ import annotations

from dataclasses import dataclass

from course.appearance.lights.sample import (
    TO_A_POINT,
    TO_A_SURFACE,
    Sample,
    emitted_cosine,
    inverse_square,
)
from course.core.types import Floats32


@dataclass(frozen=True)
class PointLight:
    """Intensity I [W/sr] at one place: E = I cos / d^2.

    Attributes
    ----------
    normal : (3,) float32 unit, or None
        Where the light is a cell of a Lambertian emitter: the emitting side, and then I falls with the cosine to it.
    two_sided, visible : of that emitter, see ``RectangleLight``
    """

    name: str
    position: Floats32
    color: Floats32
    normal: Floats32 | None = None
    width: int = 0
    velocity: Floats32 | None = None
    two_sided: bool = False
    visible: bool = True

    @property
    def limit(self) -> float:
        """How far along ``to_light`` a blocker counts."""
        return TO_A_SURFACE if self.normal is not None and self.visible else TO_A_POINT

    def sample(self, points: Floats32, u: Floats32 | None) -> Sample:
        """See ``course.appearance.lights``."""
        to_light = self.position[:, None] - points
        inverse_length, factor = inverse_square(to_light)
        if self.normal is not None:
            factor *= emitted_cosine(self.normal, to_light, inverse_length, self.two_sided)
        return Sample(to_light, inverse_length, factor)
