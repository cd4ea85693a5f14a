"""Next to cos = 1 a small difference of two large numbers is left: it has no digits."""

import numpy as np

FUNCTION = "ggx"
CAUGHT_BY = "sharp"
MISTAKE = None


def ggx(cos, alpha):
    """With a mistake."""
    _check(alpha, cos=(cos, "N"))
    spread = cos * cos * cos.dtype.type(alpha * alpha - 1) + 1
    return np.where(cos > 0, alpha * alpha / np.pi / (spread * spread), 0).astype(cos.dtype)
