"""All paths in the direction of the first."""

import numpy as np

FUNCTION = "diffuse_bounce"
CAUGHT_BY = "density"
MISTAKE = "not-by-its-column"


def diffuse_bounce(normal, u):
    """With a mistake."""
    _check_batch("normal", normal, 3)
    _check_batch("u", u, 2, np.shape(normal)[1])
    u = np.repeat(u[:, :1], u.shape[1], axis=1)
    phi = u.dtype.type(2 * np.pi) * u[1]
    r, c = np.sqrt(u[0]), np.sqrt(1 - u[0])
    a, b = r * np.cos(phi), r * np.sin(phi)
    x, y, z = normal
    sign = np.copysign(normal.dtype.type(1), z)
    sunk = sign * x * a + y * b
    rest = c - sunk / (sign + z)
    return np.stack((x * rest + a, y * rest + sign * b, c * z - sunk))
