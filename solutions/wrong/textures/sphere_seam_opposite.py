"""Along the half circle where the picture ends meet the middle of the picture is shown."""

import numpy as np

FUNCTION = "sphere_uv"
CAUGHT_BY = "known"
MISTAKE = None


def sphere_uv(p, center):
    """With a mistake."""
    _check_batch("p", p, 3)
    _check_point("center", center)
    x, y, z = p - np.asarray(center, p.dtype)[:, None]
    u = np.arctan2(-z, x) / (2 * np.pi)
    v = np.arctan2(y, np.hypot(x, z)) / np.pi + 0.5
    return np.stack((np.where((z == 0) & (x > 0), 0.5, u + (u < 0)), v))
