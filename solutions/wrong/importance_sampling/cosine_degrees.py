"""The turn in degrees."""

import numpy as np

FUNCTION = "cosine_hemisphere"
CAUGHT_BY = "smooth"
MISTAKE = "degrees"
SAYS = "Your turn is in degrees; NumPy's sine and cosine take radians."


def cosine_hemisphere(u):
    """With a mistake."""
    _check_rows("u", u, 2)
    r, phi = np.sqrt(u[0]), u.dtype.type(360) * u[1]
    return np.stack((r * np.cos(phi), r * np.sin(phi), np.sqrt(1 - u[0])))
