"""One number for radius and angle: a spiral."""

import numpy as np

FUNCTION = "disk_by_polar"
CAUGHT_BY = "uniform"
MISTAKE = "disk-one-number"
SAYS = "One row of u has no effect: radius and angle each need a number of their own."


def disk_by_polar(u):
    """A polar warp."""
    _check_batch("u", u, 2)
    phi = u.dtype.type(2 * np.pi) * u[0]
    return np.sqrt(u[0]) * np.stack((np.cos(phi), np.sin(phi)))
