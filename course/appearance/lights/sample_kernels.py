"""What arrives from points on lights, compiled by Numba; imported by ``sample``, when it is used."""

from __future__ import annotations

import numpy as np
from numba import njit, types

from course.appearance.lights.sample import CLOSEST
from course.geometry.kernels import COLUMNS, OPTIONS, ROW

_NOTHING, _ONE = np.float32(0), np.float32(1)
_LEAST = np.float32(CLOSEST * CLOSEST)


@njit(types.void(COLUMNS, COLUMNS, ROW, types.boolean, COLUMNS, ROW, ROW), **OPTIONS)
def towards(on_light, points, normal, two_sided, to_light, inverse_length, factor):
    """Fill what ``Sample`` says of n points.

    Parameters
    ----------
    on_light : (3, n) or (3, 1)
    points : (3, n)
    normal : (3,) of a Lambertian emitter, or (0,)
    two_sided : whether both its sides shine
    to_light, inverse_length, factor : (3, n) and (n,), filled
    """
    emitter = len(normal) > 0
    for i in range(points.shape[1]):
        k = 0 if on_light.shape[1] == 1 else i
        x, y, z = (
            on_light[0, k] - points[0, i],
            on_light[1, k] - points[1, i],
            on_light[2, k] - points[2, i],
        )
        share = _ONE / max(x * x + y * y + z * z, _LEAST)
        inverse = np.sqrt(share)
        if emitter:
            cosine = -inverse * (normal[0] * x + normal[1] * y + normal[2] * z)
            share *= abs(cosine) if two_sided else (cosine if cosine > 0 else _NOTHING)
        to_light[0, i], to_light[1, i], to_light[2, i] = x, y, z
        inverse_length[i], factor[i] = inverse, share
