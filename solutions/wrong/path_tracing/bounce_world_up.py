"""The hemisphere about the z axis."""

import numpy as np

FUNCTION = "diffuse_bounce"
CAUGHT_BY = "hemisphere"
MISTAKE = "normal-ignored"
SAYS = "Your directions don't depend on the normal: they are about an axis of the world."


def diffuse_bounce(normal, u):
    """With a mistake."""
    _check_batch("normal", normal, 3)
    _check_batch("u", u, 2, np.shape(normal)[1])
    phi = u.dtype.type(2 * np.pi) * u[1]
    r = np.sqrt(u[0])
    dtype = np.result_type(normal, u)
    return np.stack((r * np.cos(phi), r * np.sin(phi), np.sqrt(1 - u[0]))).astype(dtype)
