"""A sphere: a cloud of point lights (by intensity) or a Lambertian emitter (by radiance)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from course.appearance.lights.sample import TO_A_POINT, TO_A_SURFACE, Sample, inverse_square
from course.core.types import Floats32
from course.core.vectors import dot

PointOnSphere = Callable[[Floats32, float, Floats32], Floats32]


@dataclass(frozen=True)
class SphereLight:
    """Sampled uniformly by area.

    Attributes
    ----------
    center : (3,) float32
    radius : float > 0 (a sphere of radius 0 is compiled into a point light)
    emitter : whether it is a Lambertian emitter, whose points shine outwards only
    color : (3,) float32, I / pi, or radiance times area / pi
    point_on_sphere : the function of the soft_shadows module
    """

    name: str
    center: Floats32
    radius: float
    emitter: bool
    color: Floats32
    point_on_sphere: PointOnSphere
    width: int = 2

    @property
    def limit(self) -> float:
        """How far along ``to_light`` a blocker counts."""
        return TO_A_POINT if not self.emitter else TO_A_SURFACE

    def sample(self, points: Floats32, u: Floats32 | None) -> Sample:
        """See ``course.appearance.lights``."""
        assert u is not None
        on_sphere = self.point_on_sphere(self.center, self.radius, u)
        to_light = on_sphere - points
        inverse_length, factor = inverse_square(to_light)
        if self.emitter:
            on_sphere -= self.center[:, None]
            cosine = dot(on_sphere, to_light)
            cosine *= inverse_length
            cosine *= np.float32(-1 / self.radius)
            factor *= np.maximum(cosine, 0, out=cosine)
        return Sample(to_light, inverse_length, factor)
