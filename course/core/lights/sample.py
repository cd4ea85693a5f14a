"""The interface of lights: a light samples one point on itself for each shading point."""

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from course.core.types import Floats32
from course.core.vectors import dot

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


Towards = Callable[..., Sample]
"""Makes the sample of points on a light (3, n) for shading points (3, n): ``towards``, or its compiled form."""

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

    @abstractmethod
    def sample(self, points: Floats32, u: Floats32 | None, towards: Towards) -> Sample:
        """One point on the light for each shading point.

        Parameters
        ----------
        points : (3, n) float32
        u : (width, n) float32 in [0, 1), None where the width is 0
        towards : the function of that name below, or its compiled form
        """


def towards(
    on_light: Floats32, points: Floats32, normal: Floats32 | None = None, two_sided: bool = False
) -> Sample:
    """The sample for shading points (3, n) and points on a light, (3, n) or (3, 1).

    A Lambertian emitter has a normal, and may be two-sided (``RectangleLight``); a light with an intensity has none.
    """
    to_light = on_light - points
    inverse_length, factor = inverse_square(to_light)
    if normal is not None:
        factor *= _emitted_cosine(normal, to_light, inverse_length, two_sided)
    return Sample(to_light, inverse_length, factor)


def inverse_square(to_light: Floats32) -> tuple[Floats32, Floats32]:
    """1 / d and 1 / d^2 of vectors (3, n), d clamped to at least CLOSEST."""
    squared = dot(to_light, to_light)
    np.maximum(squared, np.float32(CLOSEST * CLOSEST), out=squared)
    inverse = np.divide(np.float32(1), squared, out=squared)
    return np.sqrt(inverse), inverse


def _emitted_cosine(
    normal: Floats32, to_light: Floats32, inverse_length: Floats32, two_sided: bool
) -> Floats32:
    """Cosine (n,) between an emitter's normal (3,) and the emitted direction: at least 0, or absolute if two-sided."""
    cosine = dot(normal[:, None], to_light)
    cosine *= -inverse_length
    if two_sided:
        return np.abs(cosine, out=cosine)
    return np.maximum(cosine, 0, out=cosine)
