"""A radius that is uniform on the disk."""

import numpy as np

FUNCTION = "disk_by_polar"
CAUGHT_BY = "uniform"
MISTAKE = "disk-crowded-centre"
SAYS = "Your points crowd the centre: a uniform radius is not uniform in area."


def disk_by_polar(u):
    """A polar warp."""
    _check_batch("u", u, 2)
    phi = u.dtype.type(2 * np.pi) * u[1]
    return u[0] * np.stack((np.cos(phi), np.sin(phi)))
