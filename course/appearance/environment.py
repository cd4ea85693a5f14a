"""What a ray sees that leaves the scene."""

from __future__ import annotations

from dataclasses import dataclass

from course.core.types import Floats32


@dataclass(frozen=True)
class ConstantEnvironment:
    """The same radiance from every direction.

    Attributes
    ----------
    color : (3,) float32 [W/(m^2 sr)]
    lights : whether it lights diffuse surfaces
    """

    color: Floats32
    lights: bool = False

    @property
    def black(self) -> bool:
        """Whether there is nothing to see, so that nobody needs to look."""
        return not self.color.any()

    def radiance(self, direction: Floats32) -> Floats32:
        """(3, 1) radiance from directions (3, n)."""
        return self.color[:, None]
