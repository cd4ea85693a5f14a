"""Near the poles less than unit length: the ring is never quite nothing."""

import numpy as np

FUNCTION = "sphere_by_polar"
CAUGHT_BY = "radius"
MISTAKE = "ring-too-small"
SAYS = "The points are nearer to the centre than 1, most of all at the equator."


def sphere_by_polar(u):
    """A polar warp."""
    _check_batch("u", u, 2)
    z = 1 - 2 * u[0]
    ring = np.sqrt(1 - z * z) * u.dtype.type(0.99)
    phi = 2 * np.pi * u[1]
    return np.stack((ring * np.cos(phi), ring * np.sin(phi), z))
