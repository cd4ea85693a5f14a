"""Half a turn."""

import numpy as np

FUNCTION = "uniform_hemisphere"
CAUGHT_BY = "density"
MISTAKE = "half-turn"
SAYS = "Your directions go round half a turn only."


def uniform_hemisphere(u):
    """With a mistake."""
    _check_rows("u", u, 2)
    z = u[0]
    ring = np.sqrt((1 - z) * (1 + z))
    phi = u.dtype.type(np.pi) * u[1]
    return np.stack((ring * np.cos(phi), ring * np.sin(phi), z))
