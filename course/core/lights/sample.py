"""One point on a light for each shading point."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from course.core.types import Floats32
from course.core.vectors import dot

TO_A_POINT = 1 - 2.0**-20
"""Length of a shadow ray to a point that belongs to no surface, as a share of the distance."""

TO_A_SURFACE = 1 - 1e-4
"""... to a point on the triangles of a visible light, which must not block their own light."""


TO_THE_LIGHT = 1 + 2.0**-15
"""... to a point light on a surface that shall block it. The excess is for rounding: at a distance of 1/50 of the
scene's size and at 60 degrees, the distance to a surface is wrong by about half of the excess."""


@dataclass(frozen=True)
class Sample:
    """Points on a light, relative to the shading points.

    Attributes
    ----------
    to_light : (3, n) or (3, 1) float32, from the shading point to the point on the light, not normalised
    inverse_length : (n,) or (1,) float32, 1 / its length
    factor : (n,) or (1,) float32, irradiance of an unoccluded surface that faces the light, in units of the light's
        ``color``; 0 if the light faces away
    """

    to_light: Floats32
    inverse_length: Floats32
    factor: Floats32


Towards = Callable[..., Sample]
"""``towards``, or its compiled form."""

CLOSEST = 1e-7
"""Distances [unit of the compiled scene] are clamped to at least this, so that no light is infinitely bright."""


def towards(
    on_light: Floats32,
    points: Floats32,
    normal: Floats32 | None = None,
    two_sided: bool = False,
) -> Sample:
    """Make the sample for shading points (3, n) from points on a light, (3, n) or (3, 1).

    normal and two_sided are those of a Lambertian emitter (``RectangleLight``); a light by intensity has no normal.
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
    """Cosine (n,) between an emitter's normal (3,) and the emitted direction; if negative, its absolute value or 0."""
    cosine = dot(normal[:, None], to_light)
    cosine *= -inverse_length
    if two_sided:
        return np.abs(cosine, out=cosine)
    return np.maximum(cosine, 0, out=cosine)
