"""Along the surface the distribution is its formula, and not 0."""

import numpy as np

FUNCTION = "ggx"
CAUGHT_BY = "below"
MISTAKE = None


def ggx(cos, alpha):
    """With a mistake."""
    _check(alpha, cos=(cos, "N"))
    spread = (1 - cos) * (1 + cos) + (alpha * cos) ** 2
    return np.where(cos >= 0, alpha * alpha / np.pi / (spread * spread), 0).astype(cos.dtype)
