"""The interface of lights: a light samples one point on itself for each shading point."""

from abc import ABC, abstractmethod
from dataclasses import dataclass, replace

import numpy as np

from course.engine.core.types import Floats32, Floats64
from course.engine.core.vectors import dot

TO_A_POINT, TO_A_SURFACE, TO_THE_LIGHT = 1 - 2.0**-20, 1 - 1e-4, 1 + 2.0**-15
"""Lengths of shadow rays, as fractions of the distance to the light. The first is for points that belong to no
surface. The second is for visible lights: it ends short of their own triangles. The third ends behind a point light
on a surface, so that the surface blocks it. For a ray of 1/50 of the scene's size, at 60 degrees to
the surface's normal, rounding moves the hit by 2^-16 of the ray's length; the third one allows twice that."""


@dataclass(frozen=True)
class Sample:
    """One point on a light for each shading point.

    Attributes
    ----------
    to_light : (3, n) or (3, 1) float32, from the shading point to the point on the light, not normalised
    inverse_length : (n,) or (1,) float32, 1 / its length
    factor : (n,) or (1,) float32; 0 if the light faces away. ``factor * Light.color`` is the unoccluded irradiance / pi
        of a surface at right angles to ``to_light``
    """

    to_light: Floats32
    inverse_length: Floats32
    factor: Floats32


RAISED = np.float32(2.0**-19)
"""Height above an emitter [unit of the compiled scene] at which shadow rays end."""

CLOSEST = 1e-7
"""Distances [unit of the compiled scene] are clamped to at least this, so that no light is infinitely bright."""


class Light(ABC):
    """The interface of a light.

    Attributes
    ----------
    name : unique; the key of the light's random numbers, and its name in receipts and messages
    color : (3,) float32, see ``Sample.factor``; the BRDF's division by pi is included here
    width : number of random numbers per sample, 0 for lights without extent
    velocity : (3,) float32, displacement while the shutter is open; None at rest
    """

    name: str
    color: Floats32
    width: int
    velocity: Floats32 | None

    @property
    @abstractmethod
    def limit(self) -> float:
        """Length of the shadow rays, as a fraction of the distance to the light."""

    def short_of(self, to_light: Floats32) -> Floats32:
        """Vectors (3, n) of shadow rays that end before the light."""
        return to_light

    @abstractmethod
    def sample(self, points: Floats32, u: Floats32 | None) -> Sample:
        """One point on the light for each shading point.

        Parameters
        ----------
        points : (3, n) float32
        u : (width, n) float32 in [0, 1), None where the width is 0
        """


class FlatLight(Light):
    """A light that may be a flat Lambertian emitter.

    Attributes
    ----------
    normal : (3,) float64 unit, on the side that emits; None if the points have an intensity
    two_sided : true if the back emits like the front
    visible : true if an emitter is also a surface of the scene
    """

    normal: Floats64 | None
    two_sided: bool
    visible: bool

    @property
    def limit(self) -> float:
        """See ``Light``."""
        return TO_A_SURFACE if self.normal is not None and self.visible else TO_A_POINT

    def height(self, points: Floats32, place: Floats32) -> Floats32:
        """Height (n,) of points (3, n) above the plane through places, (3, 1) or (3, n)."""
        assert self.normal is not None
        # In float64: close to the plane, float32 would lose the height to the way along it.
        return dot(self.normal[:, None], points - place.astype(np.float64)).astype(np.float32)

    def short_of(self, to_light: Floats32) -> Floats32:
        """Ends above the emitter: a ray at a small angle to its plane would hit it before its end, by rounding."""
        if self.normal is None:
            return to_light
        normal = self.normal[:, None].astype(np.float32)
        return to_light + normal * np.clip(dot(normal, to_light) / -2, -RAISED, RAISED)

    def from_point(self, on_light: Floats32, points: Floats32, place: Floats32) -> Sample:
        """``towards``, times an emitter's cosine; ``place`` as in ``height``."""
        sample = towards(on_light, points)
        if self.normal is None:
            return sample
        cosine = self.height(points, place) * sample.inverse_length
        cosine = np.abs(cosine) if self.two_sided else np.maximum(cosine, 0)
        return replace(sample, factor=sample.factor * cosine)


def towards(on_light: Floats32, points: Floats32) -> Sample:
    """The sample for shading points (3, n) and points on a light with an intensity, (3, n) or (3, 1)."""
    to_light = on_light - points
    return Sample(to_light, *inverse_square(to_light))


def inverse_square(to_light: Floats32) -> tuple[Floats32, Floats32]:
    """1 / d and 1 / d^2 of vectors (3, n), d clamped to at least CLOSEST."""
    squared = dot(to_light, to_light)
    np.maximum(squared, np.float32(CLOSEST * CLOSEST), out=squared)
    inverse = np.divide(np.float32(1), squared, out=squared)
    return np.sqrt(inverse), inverse
