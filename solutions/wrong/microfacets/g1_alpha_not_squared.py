"""Alpha is squared beneath the root, as the tangent is."""

import numpy as np

FUNCTION = "smith_g1"
CAUGHT_BY = "values"
MISTAKE = "g1-alpha-not-squared"
SAYS = "Alpha is squared beneath the root, as the tangent is."


def smith_g1(cos, alpha):
    """With a mistake."""
    _check(alpha, cos=(cos, "N"))
    up = np.maximum(cos, 0)
    root = np.sqrt(up * up + alpha * ((1 - up) * (1 + up)))
    return (2 * up / (up + root)).astype(cos.dtype)
