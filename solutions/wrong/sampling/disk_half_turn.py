"""Half a turn."""

import numpy as np

FUNCTION = "disk_by_polar"
CAUGHT_BY = "uniform"
MISTAKE = "disk-half-turn"
SAYS = "Your points stay on one half of the disk: the angle covers half a turn."


def disk_by_polar(u):
    """A polar warp."""
    _check_batch("u", u, 2)
    phi = u.dtype.type(2 * np.pi) * u[1]
    return np.sqrt(u[0]) * np.stack((np.cos(phi / 2), np.sin(phi / 2)))
