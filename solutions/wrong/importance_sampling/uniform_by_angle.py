"""An angle from the pole that is uniform instead of the height."""

import numpy as np

FUNCTION = "uniform_hemisphere"
CAUGHT_BY = "density"
MISTAKE = "uniform-angle"
SAYS = "Your directions crowd the pole: what is uniform is the height, not the angle."


def uniform_hemisphere(u):
    """With a mistake."""
    _check_rows("u", u, 2)
    phi = u.dtype.type(2 * np.pi) * u[1]
    theta = u.dtype.type(np.pi / 2) * u[0]
    r, z = np.sin(theta), np.cos(theta)
    return np.stack((r * np.cos(phi), r * np.sin(phi), z))
