"""A disk crowded at its centre, lifted."""

import numpy as np

FUNCTION = "cosine_hemisphere"
CAUGHT_BY = "density"
MISTAKE = "disk-crowded-centre"
SAYS = "The disk that you lift to the hemisphere is crowded at its centre."


def cosine_hemisphere(u):
    """With a mistake."""
    _check_rows("u", u, 2)
    phi = u.dtype.type(2 * np.pi) * u[1]
    r = u[0]
    z = np.sqrt(1 - r * r)
    return np.stack((r * np.cos(phi), r * np.sin(phi), z))
