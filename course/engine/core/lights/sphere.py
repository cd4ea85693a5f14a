"""A spherical light: point lights spread over the sphere, or a Lambertian emitter."""

from dataclasses import dataclass

import numpy as np

from course.engine.core.lights.sample import (
    TO_A_POINT,
    TO_A_SURFACE,
    Light,
    Sample,
    inverse_square,
    towards,
)
from course.engine.core.types import Floats32, Functions
from course.engine.core.vectors import dot


@dataclass(frozen=True)
class SphereLight(Light):
    """A sphere. Its points are uniform on the sphere, in the ball, or on a disk that faces the shading point.

    Attributes
    ----------
    center : (3,) float32
    radius : float > 0; a sphere of radius 0 is built as a point light
    emitter : true if it is a Lambertian emitter
    color : (3,) float32, intensity / pi, or radiance times area / pi
    samples : the points lie on the "sphere", in the "ball", or on a "facing disk" for each shading point
    """

    name: str
    center: Floats32
    radius: float
    emitter: bool
    color: Floats32
    samples: str
    soft_shadows: Functions
    width: int = 2
    velocity: Floats32 | None = None

    @property
    def limit(self) -> float:
        """See ``Light``."""
        return TO_A_POINT if not self.emitter else TO_A_SURFACE

    def sample(self, points: Floats32, u: Floats32 | None) -> Sample:
        """See ``Light``."""
        assert u is not None
        if self.emitter:
            return self._sample_emitter(points, u)
        return towards(self.on_light(self.center, points, u), points)

    def on_light(self, center: Floats32, points: Floats32, u: Floats32) -> Floats32:
        """Points (3, n) on the light, moved to the given centre."""
        on_light: Floats32
        match self.samples:
            case "sphere":
                on_light = self.soft_shadows.point_on_sphere(center, self.radius, u)
            case "ball":
                on_light = self.soft_shadows.point_in_ball(center, self.radius, u)
            case _:  # a facing disk
                points = np.ascontiguousarray(points)
                on_light = self.soft_shadows.point_on_facing_disk(center, self.radius, points, u)
        return on_light

    def _sample_emitter(self, points: Floats32, u: Floats32) -> Sample:
        # Drawn on a sphere around the origin, a point is r times its normal. Around a distant centre, rounding could
        # move it by more than the radius. With x the point, c the centre, d the distance and r the radius,
        # cos' = -(x - c) . to_light / (r d).
        from_center = self.on_light(np.zeros(3, np.float32), points, u)
        to_light = from_center + self.center[:, None]
        to_light -= points
        inverse_length, factor = inverse_square(to_light)
        cosine = dot(from_center, to_light)
        cosine *= inverse_length
        cosine *= np.float32(-1 / self.radius)
        factor *= np.maximum(cosine, 0, out=cosine)
        return Sample(to_light, inverse_length, factor)
