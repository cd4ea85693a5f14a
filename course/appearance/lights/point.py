"""A light without extent."""

from __future__ import annotations

from dataclasses import dataclass

from course.appearance.lights.sample import (
    TO_A_POINT,
    TO_A_SURFACE,
    TO_THE_LIGHT,
    Sample,
    towards,
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
    whole : whether a surface in which the light lies hides it
    """

    name: str
    position: Floats32
    color: Floats32
    normal: Floats32 | None = None
    width: int = 0
    velocity: Floats32 | None = None
    two_sided: bool = False
    visible: bool = True
    whole: bool = False

    @property
    def limit(self) -> float:
        """How far along ``to_light`` a blocker counts."""
        if self.whole:
            return TO_THE_LIGHT
        return TO_A_SURFACE if self.normal is not None and self.visible else TO_A_POINT

    def sample(self, points: Floats32, u: Floats32 | None, compiled: bool = False) -> Sample:
        """See ``course.appearance.lights``."""
        return towards(self.position[:, None], points, self.normal, self.two_sided, compiled)
