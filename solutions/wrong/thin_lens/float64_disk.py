"""The result is double precision whatever u is."""

import numpy as np

FUNCTION = "point_on_disk"
CAUGHT_BY = "contract"
MISTAKE = "other-dtype"


def point_on_disk(u):
    """Points by radius and angle."""
    _check_batch("u", u, 2)
    phi = 2 * np.pi * u[1].astype(np.float64)
    return np.sqrt(u[0]) * np.stack((np.cos(phi), np.sin(phi)))
