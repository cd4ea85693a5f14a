"""v grows with the height."""

import numpy as np

FUNCTION = "sphere_uv"
CAUGHT_BY = "everywhere"
MISTAKE = "height-for-angle"
SAYS = "Your v grows evenly with the height; it has to with the angle."


def sphere_uv(p, center):
    """Places on a sphere."""
    _check_batch("p", p, 3)
    _check_point("center", center)
    x, y, z = p - np.asarray(center, p.dtype)[:, None]
    pi = p.dtype.type(np.pi)
    u = np.arctan2(-z, x) / (2 * pi)
    u = u - np.floor(u)
    v = y / np.sqrt(x * x + y * y + z * z) / 2 + p.dtype.type(0.5)
    return np.stack((u, v))
