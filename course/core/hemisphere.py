"""Cosine-weighted directions about a normal, for the engine's own use."""

from __future__ import annotations

import numpy as np

from course.core.types import Floats32


def cosine_directions(normal: Floats32, u: Floats32) -> Floats32:
    """Unit directions with density cos / pi about each normal, (3, N).

    A uniform point of the disk is lifted to the hemisphere (Malley); the tangents come from the normal without a
    branch (Duff et al. 2017).

    Parameters
    ----------
    normal : (3, N) float32, unit length
    u : (2, N) float32 in [0, 1)
    """
    x, y, z = normal
    sign = np.copysign(np.float32(1), z)
    a = -1 / (sign + z)
    b = x * y * a
    phi = np.float32(2 * np.pi) * u[1]
    radius = np.sqrt(u[0])
    p, q = radius * np.cos(phi), radius * np.sin(phi)
    height = np.sqrt(1 - u[0])
    direction: Floats32 = normal * height
    direction[0] += p * (1 + sign * x * x * a) + q * b
    direction[1] += p * (sign * b) + q * (sign + y * y * a)
    direction[2] -= p * (sign * x) + q * y
    return direction
