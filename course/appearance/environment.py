"""What a ray sees that leaves the scene."""

from __future__ import annotations

from dataclasses import dataclass

from course.appearance.environment_hemispheres import HemisphereSampling
from course.core.hemisphere import cosine_directions
from course.core.types import Floats32


@dataclass(frozen=True)
class ConstantEnvironment:
    """The same radiance from every direction.

    Attributes
    ----------
    color : (3,) float32 [W/(m^2 sr)]
    lights : whether it lights diffuse surfaces
    chosen : draws the directions that light comes from; None where the renderer's own cosine does
    """

    color: Floats32
    lights: bool = False
    chosen: HemisphereSampling | None = None

    @property
    def black(self) -> bool:
        """Whether there is nothing to see, so that nobody needs to look."""
        return not self.color.any()

    def radiance(self, direction: Floats32) -> Floats32:
        """(3, 1) radiance from directions (3, n)."""
        return self.color[:, None]

    def sample(
        self, normal: Floats32, u: Floats32, compiled: bool = False
    ) -> tuple[Floats32, Floats32 | None]:
        """Directions that light may come from, for the irradiance over pi.

        Parameters
        ----------
        normal : (3, n) float32, unit length
        u : (2, n) float32 in [0, 1)
        compiled : whether compiled loops are used, where there are any

        Returns
        -------
        direction : (3, n) float32, unit length
        weight : (n,) float32, cosine over pi times density, not above 0 below the horizon; None where it is 1
            everywhere
        """
        if self.chosen is not None:
            return self.chosen.sample(normal, u)
        return cosine_directions(normal, u), None
