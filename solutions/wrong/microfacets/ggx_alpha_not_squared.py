"""Alpha is to be squared, above and below."""

import numpy as np

FUNCTION = "ggx"
CAUGHT_BY = "values"
MISTAKE = "alpha-not-squared"
SAYS = "Alpha is to be squared, above and below."


def ggx(cos, alpha):
    """With a mistake."""
    _check(alpha, cos=(cos, "N"))
    alpha = alpha**0.5
    spread = (1 - cos) * (1 + cos) + (alpha * cos) ** 2
    return np.where(cos > 0, alpha * alpha / np.pi / (spread * spread), 0).astype(cos.dtype)
