"""The square on which a rough mirror's directions lie, turned by the smallest component of the direction itself."""

import numpy as np

from course.engine.core.types import Floats32
from course.engine.core.vectors import cross, dot


def jitter_on_turned_square(direction: Floats32, roughness: float, u: Floats32) -> Floats32:
    """Jitter directions r by a square: normalise(r + roughness ((u0 - 1/2) a + (u1 - 1/2) b)).

    a = normalise(t x r) and b = r x a, where t is r with its component of the smallest size set to 1, the first such
    component if there are several.

    Parameters
    ----------
    direction : (3, N) float32 unit vectors
    roughness : edge of the square at distance 1
    u : (2, N) float32 in [0, 1)

    Returns
    -------
    (3, N) float32 unit vectors
    """
    tilted = direction.copy()
    tilted[np.abs(direction).argmin(axis=0), np.arange(direction.shape[1])] = 1
    a = cross(tilted, direction)
    a *= 1 / np.sqrt(dot(a, a))
    moved = (u - np.float32(0.5)) * np.float32(roughness)
    jittered: Floats32 = direction + moved[0] * a + moved[1] * cross(direction, a)
    jittered *= 1 / np.sqrt(dot(jittered, jittered))
    return jittered
