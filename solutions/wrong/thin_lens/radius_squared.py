"""The radius is squared where its root was meant."""

import numpy as np

FUNCTION = "point_on_disk"
CAUGHT_BY = "uniform"
MISTAKE = "radius-squared"
SAYS = "Your points crowd the centre even more than a uniform radius would: you warp it the wrong way round."


def point_on_disk(u):
    """Points by radius and angle."""
    _check_batch("u", u, 2)
    two_pi = u.dtype.type(2 * np.pi)
    return u[0] ** 2 * np.stack((np.cos(two_pi * u[1]), np.sin(two_pi * u[1])))
