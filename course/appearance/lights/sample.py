"""One point on a light for each shading point."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from course.core.types import Floats32
from course.core.vectors import dot

TO_A_POINT = 1 - 2.0**-20
"""How far shadow rays go to a point that belongs to no surface, as a share of the way."""

TO_A_SURFACE = 1 - 1e-4
"""... and to a point on the triangles of a visible light, which must not block their own light."""


TO_THE_LIGHT = 1 + 2.0**-15
"""... and to a point that a surface hides which passes through it. The rest is for rounding: on a way of a fiftieth of
the scene's size, and under 60 degrees, the distance to a surface is wrong by about half of it."""


@dataclass(frozen=True)
class Sample:
    """Directions to the light and what arrives from there.

    Attributes
    ----------
    to_light : (3, n) or (3, 1) float32, from the shading point to the point on the light, not normalised
    inverse_length : (n,) or (1,) float32, 1 over its length
    factor : (n,) or (1,) float32
        Irradiance of an unoccluded surface that faces the light, in units of the light's ``color``; 0 where the
        light faces away.
    """

    to_light: Floats32
    inverse_length: Floats32
    factor: Floats32


CLOSEST = 1e-7
"""Distances below this, in the unit of the compiled scene, count as this: no light is infinitely bright."""

_NONE = np.empty(0, np.float32)


def towards(
    on_light: Floats32,
    points: Floats32,
    normal: Floats32 | None = None,
    two_sided: bool = False,
    compiled: bool = False,
) -> Sample:
    """What arrives at points (3, n) from points on a light, (3, n) or (3, 1), that shine alike in all directions.

    Parameters
    ----------
    normal, two_sided : of a Lambertian emitter, see ``RectangleLight``; None for a light by intensity
    compiled : by a compiled loop, to the same bits
    """
    if compiled:
        return _towards_by_loop(on_light, points, normal, two_sided)
    to_light = on_light - points
    inverse_length, factor = inverse_square(to_light)
    if normal is not None:
        factor *= _emitted_cosine(normal, to_light, inverse_length, two_sided)
    return Sample(to_light, inverse_length, factor)


def _towards_by_loop(
    on_light: Floats32, points: Floats32, normal: Floats32 | None, two_sided: bool
) -> Sample:
    from course.appearance.lights import sample_kernels

    n = points.shape[1]
    sample = Sample(np.empty((3, n), np.float32), np.empty(n, np.float32), np.empty(n, np.float32))
    sample_kernels.towards(
        *map(np.ascontiguousarray, (on_light, points, _NONE if normal is None else normal)),
        two_sided,
        *(sample.to_light, sample.inverse_length, sample.factor),
    )
    return sample


def inverse_square(to_light: Floats32) -> tuple[Floats32, Floats32]:
    """1 / d and 1 / d^2 of vectors (3, n), with d at least CLOSEST."""
    squared = dot(to_light, to_light)
    np.maximum(squared, np.float32(CLOSEST * CLOSEST), out=squared)
    inverse = np.divide(np.float32(1), squared, out=squared)
    return np.sqrt(inverse), inverse


def _emitted_cosine(
    normal: Floats32, to_light: Floats32, inverse_length: Floats32, two_sided: bool
) -> Floats32:
    """Cosine (n,) between an emitter's normal (3,) and the way it shines; behind it 0, or as in front of it."""
    cosine = dot(normal[:, None], to_light)
    cosine *= -inverse_length
    if two_sided:
        return np.abs(cosine, out=cosine)
    return np.maximum(cosine, 0, out=cosine)
