"""Angles below 0 are left there."""

import numpy as np

FUNCTION = "sphere_uv"
CAUGHT_BY = "range"
MISTAKE = "negative"
SAYS = "Half of your u are negative; they have to be from 0 to 1."


def sphere_uv(p, center):
    """Places on a sphere."""
    _check_batch("p", p, 3)
    _check_point("center", center)
    x, y, z = p - np.asarray(center, p.dtype)[:, None]
    pi = p.dtype.type(np.pi)
    u = np.arctan2(-z, x) / (2 * pi)
    v = np.arctan2(y, np.hypot(x, z)) / pi + p.dtype.type(0.5)
    return np.stack((u, v))
