"""The radius is u^0.51 instead of the square root."""

import numpy as np

FUNCTION = "point_on_disk"
CAUGHT_BY = "order"
MISTAKE = None


def point_on_disk(u):
    """Points of the disk, a little too near to its centre."""
    _check_batch("u", u, 2)
    turn = u.dtype.type(2 * np.pi) * u[1]
    return u[0] ** u.dtype.type(0.51) * np.stack((np.cos(turn), np.sin(turn)))
