"""The radius is uniform, so the points crowd the centre."""

import numpy as np

FUNCTION = "point_on_disk"
CAUGHT_BY = "uniform"
MISTAKE = "crowded-centre"
SAYS = "Your points crowd the centre: a uniform radius is not uniform in area."


def point_on_disk(u):
    """Points by radius and angle."""
    _check_batch("u", u, 2)
    two_pi = u.dtype.type(2 * np.pi)
    return u[0] * np.stack((np.cos(two_pi * u[1]), np.sin(two_pi * u[1])))
