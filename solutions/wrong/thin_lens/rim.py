"""The points lie on the rim."""

import numpy as np

FUNCTION = "point_on_disk"
CAUGHT_BY = "uniform"
MISTAKE = "rim-only"
SAYS = "Your points all lie on the rim; they have to fill the disk."


def point_on_disk(u):
    """Points by radius and angle."""
    _check_batch("u", u, 2)
    two_pi = u.dtype.type(2 * np.pi)
    return np.stack((np.cos(two_pi * u[1]), np.sin(two_pi * u[1])))
