"""You took the sine for the tangent: along the surface all is hidden."""

import numpy as np

FUNCTION = "smith_g1"
CAUGHT_BY = "values"
MISTAKE = "sine-for-tangent"
SAYS = "You took the sine for the tangent: along the surface all is hidden."


def smith_g1(cos, alpha):
    """With a mistake."""
    _check(alpha, cos=(cos, "N"))
    up = np.maximum(cos, 0)
    return np.where(up > 0, 2 / (1 + np.sqrt(1 + alpha * alpha * (1 - up * up))), 0).astype(
        cos.dtype
    )
