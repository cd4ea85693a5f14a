"""Exponents end at 100."""

import numpy as np

FUNCTION = "sample_phong_lobe"
CAUGHT_BY = "narrow"
MISTAKE = "exponent-cut"
SAYS = "Your lobe gets no narrower beyond some exponent."


def sample_phong_lobe(direction, exponent, u):
    """With a mistake."""
    _check_batch("direction", direction, 3)
    _check_batch("u", u, 2, np.shape(direction)[1])
    _check_not_negative("exponent", exponent)
    dtype = np.result_type(direction, u)
    a, b = orthonormal_basis(direction)
    cos = (1 - u[0]) ** (1 / (min(exponent, 100) + 1))
    sin = np.sqrt(np.maximum(1 - cos * cos, 0))
    phi = 2 * np.pi * u[1]
    return (sin * np.cos(phi) * a + sin * np.sin(phi) * b + cos * direction).astype(dtype)
