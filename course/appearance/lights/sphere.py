"""A sphere: a cloud of point lights (by intensity) or a Lambertian emitter (by radiance)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from course.appearance.lights.sample import (
    TO_A_POINT,
    TO_A_SURFACE,
    Sample,
    inverse_square,
    towards,
)
from course.core.types import Floats32
from course.core.vectors import dot


@dataclass(frozen=True)
class SphereLight:
    """Sampled uniformly by area.

    Attributes
    ----------
    center : (3,) float32
    radius : float > 0 (a sphere of radius 0 is compiled into a point light)
    emitter : whether it is a Lambertian emitter, whose points shine outwards only
    color : (3,) float32, I / pi, or radiance times area / pi
    method : how points are found, as scene files name it: an emitter has them on its surface only, and a facing disk
        faces each shading point
    place : the function that finds them: (center, radius, u) -> (3, n), with the shading points before u for a facing
        disk
    """

    name: str
    center: Floats32
    radius: float
    emitter: bool
    color: Floats32
    method: str
    place: Callable[..., Floats32]
    width: int = 2
    velocity: Floats32 | None = None

    @property
    def limit(self) -> float:
        """How far along ``to_light`` a blocker counts."""
        return TO_A_POINT if not self.emitter else TO_A_SURFACE

    def sample(self, points: Floats32, u: Floats32 | None, compiled: bool = False) -> Sample:
        """See ``course.appearance.lights``."""
        assert u is not None
        if self.emitter:
            return self._sample_emitter(points, u)
        if self.method == "facing disk":
            on_light = self.place(self.center, self.radius, np.ascontiguousarray(points), u)
        else:
            on_light = self.place(self.center, self.radius, u)
        return towards(on_light, points, compiled=compiled)

    def _sample_emitter(self, points: Floats32, u: Floats32) -> Sample:
        # About the origin, and moved afterwards: a radius of a few float32 steps of the centre keeps its normals.
        from_center = self.place(np.zeros(3, np.float32), self.radius, u)
        to_light = from_center + self.center[:, None]
        to_light -= points
        inverse_length, factor = inverse_square(to_light)
        cosine = dot(from_center, to_light)
        cosine *= inverse_length
        cosine *= np.float32(-1 / self.radius)
        factor *= np.maximum(cosine, 0, out=cosine)
        return Sample(to_light, inverse_length, factor)
