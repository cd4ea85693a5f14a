"""The same number gives radius and angle."""

import numpy as np

FUNCTION = "point_on_disk"
CAUGHT_BY = "uniform"
MISTAKE = "one-number"
SAYS = "You use one of the two numbers only, so your points lie on a spiral."


def point_on_disk(u):
    """Points by radius and angle."""
    _check_batch("u", u, 2)
    two_pi = u.dtype.type(2 * np.pi)
    return np.sqrt(u[0]) * np.stack((np.cos(two_pi * u[0]), np.sin(two_pi * u[0])))
