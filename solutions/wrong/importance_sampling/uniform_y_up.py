"""About +y."""

import numpy as np

FUNCTION = "uniform_hemisphere"
CAUGHT_BY = "hemisphere"
MISTAKE = "y-up"
SAYS = "Your hemisphere is about +y; here the axis is +z."


def uniform_hemisphere(u):
    """With a mistake."""
    _check_rows("u", u, 2)
    height = u[0]
    ring = np.sqrt((1 - height) * (1 + height))
    phi = u.dtype.type(2 * np.pi) * u[1]
    return np.stack((ring * np.cos(phi), height, ring * np.sin(phi)))
