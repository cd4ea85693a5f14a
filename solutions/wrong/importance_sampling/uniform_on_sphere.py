"""The whole sphere."""

import numpy as np

FUNCTION = "uniform_hemisphere"
CAUGHT_BY = "hemisphere"
MISTAKE = "whole-sphere"
SAYS = "Your directions cover the whole sphere."


def uniform_hemisphere(u):
    """With a mistake."""
    _check_rows("u", u, 2)
    phi = u.dtype.type(2 * np.pi) * u[1]
    z = 1 - 2 * u[0]
    r = 2 * np.sqrt(u[0] * (1 - u[0]))
    return np.stack((r * np.cos(phi), r * np.sin(phi), z))
