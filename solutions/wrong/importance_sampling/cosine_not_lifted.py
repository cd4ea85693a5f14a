"""Points of the disk whose height is 1."""

import numpy as np

FUNCTION = "cosine_hemisphere"
CAUGHT_BY = "unit_length"
MISTAKE = "not-lifted"
SAYS = "Points of the disk got a height of 1: they aren't on the hemisphere."


def cosine_hemisphere(u):
    """With a mistake."""
    _check_rows("u", u, 2)
    phi = u.dtype.type(2 * np.pi) * u[1]
    r = np.sqrt(u[0])
    z = np.ones_like(r)
    return np.stack((r * np.cos(phi), r * np.sin(phi), z))
