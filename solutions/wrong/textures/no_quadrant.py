"""An arcus tangent of a quotient."""

import numpy as np

FUNCTION = "sphere_uv"
CAUGHT_BY = "known"
MISTAKE = "half-around"
SAYS = "Your u goes half way around only: a quotient does not know the quadrant."


def sphere_uv(p, center):
    """Places on a sphere."""
    _check_batch("p", p, 3)
    _check_point("center", center)
    x, y, z = p - np.asarray(center, p.dtype)[:, None]
    pi = p.dtype.type(np.pi)
    u = np.arctan(-z / np.where(x == 0, p.dtype.type(1e-30), x)) / (2 * pi)
    u = u - np.floor(u)
    v = np.arctan2(y, np.hypot(x, z)) / pi + p.dtype.type(0.5)
    return np.stack((u, v))
