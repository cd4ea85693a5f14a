"""The azimuth goes half way round only."""

import numpy as np

FUNCTION = "sample_phong_lobe"
CAUGHT_BY = "density"
MISTAKE = "half-turn"
SAYS = "Your lobe is only half of one: the directions go half way around the axis."


def sample_phong_lobe(direction, exponent, u):
    """Sample the lobe of Phong."""
    _check_batch("direction", direction, 3)
    _check_batch("u", u, 2, np.shape(direction)[1])
    _check_not_negative("exponent", exponent)
    dtype = np.result_type(direction, u)
    cos = (1 - u[0]) ** (1 / (exponent + 1))
    sin = np.sqrt(np.maximum(1 - cos * cos, 0))
    a, b = orthonormal_basis(direction)
    phi = np.pi * u[1]
    jittered = sin * np.cos(phi) * a + sin * np.sin(phi) * b + cos * direction
    return jittered.astype(dtype)
