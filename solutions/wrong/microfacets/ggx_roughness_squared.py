"""You squared the roughness before it was used: alpha is the slope itself."""

import numpy as np

FUNCTION = "ggx"
CAUGHT_BY = "values"
MISTAKE = "alpha-squared-twice"
SAYS = "You squared the roughness before it was used: alpha is the slope itself."


def ggx(cos, alpha):
    """With a mistake."""
    _check(alpha, cos=(cos, "N"))
    alpha = alpha * alpha
    spread = (1 - cos) * (1 + cos) + (alpha * cos) ** 2
    return np.where(cos > 0, alpha * alpha / np.pi / (spread * spread), 0).astype(cos.dtype)
