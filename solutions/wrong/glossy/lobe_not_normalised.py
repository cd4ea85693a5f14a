"""The cosine's sine forgotten."""

import numpy as np

FUNCTION = "sample_phong_lobe"
CAUGHT_BY = "unit_length"
MISTAKE = "ring-not-scaled"
SAYS = "The ring around the axis is as wide for every angle; its radius is the sine of the angle."


def sample_phong_lobe(direction, exponent, u):
    """With a mistake."""
    _check_batch("direction", direction, 3)
    _check_batch("u", u, 2, np.shape(direction)[1])
    _check_not_negative("exponent", exponent)
    dtype = np.result_type(direction, u)
    a, b = orthonormal_basis(direction)
    cos = (1 - u[0]) ** (1 / (exponent + 1))
    phi = 2 * np.pi * u[1]
    return (np.cos(phi) * a + np.sin(phi) * b + cos * direction).astype(dtype)
