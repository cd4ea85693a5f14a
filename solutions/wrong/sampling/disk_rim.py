"""The rim only."""

import numpy as np

FUNCTION = "disk_by_polar"
CAUGHT_BY = "uniform"
MISTAKE = "disk-rim-only"
SAYS = "All your points lie on the rim: the radius is never drawn."


def disk_by_polar(u):
    """A polar warp."""
    _check_batch("u", u, 2)
    phi = 2 * np.pi * u[1]
    return np.stack((np.cos(phi), np.sin(phi)))
