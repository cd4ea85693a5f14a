"""A sphere that emits light, sampled only where it can be seen from: the cone that it fills, by solid angle.

Half of a sphere's surface faces away from any point, and of the rest the rim counts little. In the cone all directions
bring the same radiance, so without blockers only the cosine at the surface is left to vary (Shirley, Wang and
Zimmerman, "Monte Carlo techniques for direct lighting calculations", 1996).
"""

from dataclasses import dataclass

import numpy as np

from course.engine.core.lights.sample import CLOSEST, TO_A_SURFACE, Light, Sample
from course.engine.core.types import Floats32
from course.engine.core.vectors import dot
from course.engine.terms.scattering.hemisphere import cone_directions


@dataclass(frozen=True)
class VisibleSphereLight(Light):
    """A Lambertian sphere; from within it nothing arrives, for it shines outwards.

    Attributes
    ----------
    center : (3,) float32
    radius : float > 0
    color : (3,) float32, radiance times area / pi
    """

    name: str
    center: Floats32
    radius: float
    color: Floats32
    width: int = 2
    velocity: Floats32 | None = None
    limit: float = TO_A_SURFACE

    def sample(self, points: Floats32, u: Floats32 | None) -> Sample:
        """See ``Light``."""
        assert u is not None
        axis = self.center[:, None] - points
        squared = dot(axis, axis)
        np.maximum(squared, np.float32(CLOSEST * CLOSEST), out=squared)
        inverse = 1 / squared
        distance = np.sqrt(squared)
        axis *= np.sqrt(inverse)
        squared_radius = np.float32(self.radius * self.radius)
        squared_sine = squared_radius * inverse
        outside = squared_sine < 1
        squared_sine = np.minimum(squared_sine, np.float32(1))
        cosine = np.sqrt(1 - squared_sine)
        # 1 - cos without the cancellation: of a distant lamp all digits would be lost.
        direction, bent = cone_directions(axis, squared_sine / (1 + cosine), u)
        # The nearer of the two places where the way meets the sphere; never quite 0.
        length = distance * np.sqrt(1 - bent)
        length -= np.sqrt(np.maximum(squared_radius - squared * bent, 0))
        np.maximum(length, np.float32(CLOSEST), out=length)
        direction *= length
        # The solid angle 2 pi (1 - cos) over pi, in units of the area over pi: 4 r^2.
        factor = np.float32(0.5) * inverse / (1 + cosine)
        factor *= outside
        return Sample(direction, np.divide(np.float32(1), length), factor)
