"""A point on the part of a sphere that is seen, compiled by Numba; see ``VisibleSphereLight.sample``."""

import math

import numpy as np

from course.engine.core.lights.sample import CLOSEST
from course.engine.loops.options import LEAN, njit

_NOTHING, _HALF, _ONE, _TWO = np.float32(0), np.float32(0.5), np.float32(1), np.float32(2)
_CLOSEST, _LEAST = np.float32(CLOSEST), np.float32(CLOSEST * CLOSEST)


@njit(**LEAN)
def towards_cap(x, y, z, squared, squared_radius, u, cosine, sine):
    """The vector to the point, 1 / its length, and the factor of what it sends.

    Parameters
    ----------
    x, y, z, squared : the vector to the centre, and its squared length
    u : chooses the angle from the axis; cosine and sine are those of the angle around it
    """
    squared = max(squared, _LEAST)
    inverse, distance = _ONE / squared, np.sqrt(squared)
    scale = np.sqrt(inverse)
    x, y, z = x * scale, y * scale, z * scale
    squared_sine = squared_radius * inverse
    shines = _ONE if squared_sine < _ONE else _NOTHING
    squared_sine = min(squared_sine, _ONE)
    above = _ONE + np.sqrt(_ONE - squared_sine)
    fallen = squared_sine / above * u
    bent = fallen * (_TWO - fallen)
    across, height = np.sqrt(bent), _ONE - fallen
    p, q = across * cosine, across * sine
    sign = np.float32(math.copysign(_ONE, z))
    a = -_ONE / (sign + z)
    b = x * y * a
    length = distance * np.sqrt(_ONE - bent)
    length -= np.sqrt(max(squared_radius - squared * bent, _NOTHING))
    length = max(length, _CLOSEST)
    return (
        (x * height + (p * (_ONE + sign * x * x * a) + q * b)) * length,
        (y * height + (p * (sign * b) + q * (sign + y * y * a))) * length,
        (z * height - (p * (sign * x) + q * y)) * length,
        _ONE / length,
        _HALF * inverse / above * shines,
    )
