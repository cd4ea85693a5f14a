"""Takes for granted that the radius is 1."""

import numpy as np

FUNCTION = "sphere_uv"
CAUGHT_BY = "everywhere"
MISTAKE = "radius-forgotten"
SAYS = "The point isn't divided by the radius: right for a radius of 1 alone."


def sphere_uv(p, center):
    """Places on a sphere."""
    _check_batch("p", p, 3)
    _check_point("center", center)
    x, y, z = p - np.asarray(center, p.dtype)[:, None]
    pi = p.dtype.type(np.pi)
    u = np.arctan2(-z, x) / (2 * pi)
    u = u - np.floor(u)
    v = np.arcsin(np.clip(y, -1, 1)) / pi + p.dtype.type(0.5)
    return np.stack((u, v))
