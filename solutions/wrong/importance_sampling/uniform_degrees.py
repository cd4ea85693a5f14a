"""A turn in degrees."""

import numpy as np

FUNCTION = "uniform_hemisphere"
CAUGHT_BY = "smooth"
MISTAKE = "degrees"
SAYS = "Your turn is in degrees; NumPy's sine and cosine take radians."


def uniform_hemisphere(u):
    """With a mistake."""
    _check_rows("u", u, 2)
    z = u[0]
    ring = np.sqrt((1 - z) * (1 + z))
    phi = u.dtype.type(360) * u[1]
    return np.stack((ring * np.cos(phi), ring * np.sin(phi), z))
