"""The normal and a point of the sphere, added up and left so."""

import numpy as np

FUNCTION = "diffuse_bounce"
CAUGHT_BY = "hemisphere"
MISTAKE = "bounce-not-normalised"
SAYS = "Your directions are not of unit length."


def diffuse_bounce(normal, u):
    """With a mistake."""
    _check_batch("normal", normal, 3)
    _check_batch("u", u, 2, np.shape(normal)[1])
    phi = u.dtype.type(2 * np.pi) * u[1]
    ring = 2 * np.sqrt(u[0] * (1 - u[0]))
    return normal + np.stack((ring * np.cos(phi), ring * np.sin(phi), 1 - 2 * u[0]))
