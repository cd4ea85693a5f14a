"""The cosine is taken for the sine."""

import numpy as np

FUNCTION = "sample_phong_lobe"
CAUGHT_BY = "density"
MISTAKE = "sine-for-cosine"
SAYS = "You have taken the cosine for the sine: your directions stay away from the axis."


def sample_phong_lobe(direction, exponent, u):
    """Sample the lobe of Phong."""
    _check_batch("direction", direction, 3)
    _check_batch("u", u, 2, np.shape(direction)[1])
    _check_not_negative("exponent", exponent)
    dtype = np.result_type(direction, u)
    sin = u[0] ** (1 / (exponent + 1))
    cos = np.sqrt(np.maximum(1 - sin * sin, 0))
    a, b = orthonormal_basis(direction)
    phi = 2 * np.pi * u[1]
    jittered = sin * np.cos(phi) * a + sin * np.sin(phi) * b + cos * direction
    return jittered.astype(dtype)
