"""Heights from 0 to 1."""

import numpy as np

FUNCTION = "sphere_by_polar"
CAUGHT_BY = "uniform"
MISTAKE = "sphere-upper-half"
SAYS = "Your points cover the upper half alone: the height runs from -1 to 1."


def sphere_by_polar(u):
    """A polar warp."""
    _check_batch("u", u, 2)
    phi = u.dtype.type(2 * np.pi) * u[1]
    ring = np.sqrt(1 - u[0] * u[0])
    return np.stack((ring * np.cos(phi), ring * np.sin(phi), u[0]))
