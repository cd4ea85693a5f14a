"""One number for the height and the turn."""

import numpy as np

FUNCTION = "cosine_hemisphere"
CAUGHT_BY = "density"
MISTAKE = "cosine-one-number"
SAYS = "The same number decides height and turn: the directions lie on a curve."


def cosine_hemisphere(u):
    """With a mistake."""
    _check_rows("u", u, 2)
    phi = u.dtype.type(2 * np.pi) * u[0]
    r, z = np.sqrt(u[0]), np.sqrt(1 - u[0])
    return np.stack((r * np.cos(phi), r * np.sin(phi), z))
