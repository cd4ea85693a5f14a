"""Bump maps: shading normals of a surface that is raised along its normals by heights (J. Blinn, 1978).

With heights h the surface p + h n has the normal n - grad h, to first order in h; the gradient is along the surface.
"""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from course.engine.core.types import Floats32
from course.engine.core.vectors import cross, dot
from course.engine.terms.surfaces.normal_maps import NormalMap
from course.engine.terms.surfaces.perlin import PerlinNoise, between

STEP = np.float32(1 / 64)
"""Of a grain of noise: how far on both sides of a place it is compared."""


class Heights(Protocol):
    """What raises a surface."""

    def changes(self, weights: Floats32, corners: Floats32) -> tuple[Floats32, Floats32]:
        """How heights (n,) change along the edges from corner 0 to 1, and to 2; arguments as of a ``NormalMap``."""
        ...


@dataclass(frozen=True)
class PictureHeights:
    """Grey values of a picture, the mean of red, green and blue.

    Attributes
    ----------
    picture : its colours, and where the surface has them
    step : (2,) float32, half of a pixel along u and along v
    """

    picture: NormalMap
    step: Floats32

    def changes(self, weights: Floats32, corners: Floats32) -> tuple[Floats32, Floats32]:
        """See ``Heights``."""
        place, first, second = self.picture.changes(weights, corners)
        slopes = []
        for axis, step in enumerate(self.step):
            away = np.zeros((2, 1), np.float32)
            away[axis] = step
            higher, lower = self.picture.color(place + away), self.picture.color(place - away)
            slopes.append((higher - lower).mean(axis=0) / (2 * step))
        u, v = slopes
        return u * first[0] + v * first[1], u * second[0] + v * second[1]


@dataclass(frozen=True)
class NoiseHeights:
    """Perlin's noise at the places that corners carry."""

    noise: PerlinNoise

    def changes(self, weights: Floats32, corners: Floats32) -> tuple[Floats32, Floats32]:
        """See ``Heights``."""
        place = between(weights, corners)
        slope = np.empty_like(place)
        for axis in range(3):
            away = np.zeros((3, 1), np.float32)
            away[axis] = STEP
            slope[axis] = self.noise.grey(place + away) - self.noise.grey(place - away)
        slope /= 2 * STEP
        return dot(slope, corners[1] - corners[0]), dot(slope, corners[2] - corners[0])


@dataclass(frozen=True)
class BumpMap:
    """Heights on a shape; ``height`` is that of 1, in the unit of the compiled scene."""

    heights: Heights
    height: float

    def normals(
        self, weights: Floats32, corners: Floats32, normal: Floats32, edges: Floats32
    ) -> Floats32:
        """See ``NormalMap.normals``."""
        # In double precision, for small triangles' products of lengths underflow.
        first, second = (
            self.height * change.astype(np.float64)
            for change in self.heights.changes(weights, corners)
        )
        e1, e2 = edges[0:3].astype(np.float64), edges[3:6].astype(np.float64)
        face = cross(e1, e2)
        gradient = cross(e2, face) * first + cross(face, e1) * second
        gradient /= np.maximum(dot(face, face), 1e-290)
        raised = normal - (gradient - dot(gradient, normal) * normal)
        raised /= np.sqrt(dot(raised, raised))
        return raised.astype(np.float32)
