"""The power is 1 / n instead of 1 / (n + 1)."""

import numpy as np

FUNCTION = "sample_phong_lobe"
CAUGHT_BY = "density"
MISTAKE = "exponent-off-by-one"
SAYS = "Your lobe is too wide by one in the exponent: the ring at alpha grows with sin(alpha), and integrating that raises the power by one."


def sample_phong_lobe(direction, exponent, u):
    """Sample the lobe of Phong."""
    _check_batch("direction", direction, 3)
    _check_batch("u", u, 2, np.shape(direction)[1])
    _check_not_negative("exponent", exponent)
    dtype = np.result_type(direction, u)
    cos = u[0] ** (1 / max(exponent, 1e-6))
    sin = np.sqrt(np.maximum(1 - cos * cos, 0))
    a, b = orthonormal_basis(direction)
    phi = 2 * np.pi * u[1]
    jittered = sin * np.cos(phi) * a + sin * np.sin(phi) * b + cos * direction
    return jittered.astype(dtype)
