"""Points of the sphere, turned to the normal's side where they are below."""

import numpy as np

FUNCTION = "diffuse_bounce"
CAUGHT_BY = "density"
MISTAKE = "uniform-for-cosine"


def diffuse_bounce(normal, u):
    """With a mistake."""
    _check_batch("normal", normal, 3)
    _check_batch("u", u, 2, np.shape(normal)[1])
    phi = u.dtype.type(2 * np.pi) * u[1]
    r, c = 2 * np.sqrt(u[0] * (1 - u[0])), 1 - 2 * u[0]
    d = np.stack((r * np.cos(phi), r * np.sin(phi), c))
    return np.where((d * normal).sum(axis=0) < 0, -d, d)
