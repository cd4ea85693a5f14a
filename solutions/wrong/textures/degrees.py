"""Angles in degrees, divided by 2 pi all the same."""

import numpy as np

FUNCTION = "sphere_uv"
CAUGHT_BY = "known"
MISTAKE = "degrees"
SAYS = "Your angles are in degrees; a whole turn is 2 pi."


def sphere_uv(p, center):
    """Places on a sphere."""
    _check_batch("p", p, 3)
    _check_point("center", center)
    x, y, z = p - center[:, None]
    u = np.degrees(np.arctan2(-z, x)) / (2 * np.pi)
    v = np.degrees(np.arctan2(y, np.hypot(x, z))) / np.pi + 0.5
    return np.stack((u % 1, v)).astype(p.dtype)
