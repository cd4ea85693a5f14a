"""Divides v by a whole turn, too."""

import numpy as np

FUNCTION = "sphere_uv"
CAUGHT_BY = "known"
MISTAKE = "v-by-whole-turn"
SAYS = "v is divided by a whole turn; from pole to pole it is half a turn."


def sphere_uv(p, center):
    """Places on a sphere."""
    _check_batch("p", p, 3)
    _check_point("center", center)
    x, y, z = p - np.asarray(center, p.dtype)[:, None]
    pi = p.dtype.type(np.pi)
    u = np.arctan2(-z, x) / (2 * pi)
    u = u - np.floor(u)
    v = np.arctan2(y, np.hypot(x, z)) / (2 * pi) + p.dtype.type(0.5)
    return np.stack((u, v))
