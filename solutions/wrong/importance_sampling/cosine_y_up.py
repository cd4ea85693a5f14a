"""The cosine's hemisphere about +y."""

import numpy as np

FUNCTION = "cosine_hemisphere"
CAUGHT_BY = "hemisphere"
MISTAKE = "y-up"
SAYS = "Your hemisphere is about +y; here the axis is +z."


def cosine_hemisphere(u):
    """With a mistake."""
    _check_rows("u", u, 2)
    r, phi = np.sqrt(u[0]), u.dtype.type(2 * np.pi) * u[1]
    return np.stack((r * np.cos(phi), np.sqrt(1 - u[0]), r * np.sin(phi)))
