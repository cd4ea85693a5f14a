"""The centre with the wrong sign."""

import numpy as np

FUNCTION = "sphere_uv"
CAUGHT_BY = "everywhere"
MISTAKE = "centre-added"
SAYS = "The centre is added where the way from it is asked for."


def sphere_uv(p, center):
    """Places on a sphere."""
    _check_batch("p", p, 3)
    _check_point("center", center)
    x, y, z = p + center[:, None]
    u = np.arctan2(-z, x) / (2 * np.pi)
    v = np.arctan2(y, np.hypot(x, z)) / np.pi + 0.5
    return np.stack((u + (u < 0), v)).astype(p.dtype)
