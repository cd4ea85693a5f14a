"""The disk has the diameter 1."""

import numpy as np

FUNCTION = "point_on_disk"
CAUGHT_BY = "moments"
MISTAKE = "half-as-wide"
SAYS = "Your disk has the diameter 1; the unit disk has the radius 1."


def point_on_disk(u):
    """Points by radius and angle."""
    _check_batch("u", u, 2)
    two_pi = u.dtype.type(2 * np.pi)
    return np.sqrt(u[0]) / 2 * np.stack((np.cos(two_pi * u[1]), np.sin(two_pi * u[1])))
