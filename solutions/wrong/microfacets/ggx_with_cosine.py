"""You multiplied D by the cosine: that is the area seen from above."""

import numpy as np

FUNCTION = "ggx"
CAUGHT_BY = "values"
MISTAKE = "cosine-included"
SAYS = "You multiplied D by the cosine: that is the area seen from above."


def ggx(cos, alpha):
    """With a mistake."""
    _check(alpha, cos=(cos, "N"))
    spread = (1 - cos) * (1 + cos) + (alpha * cos) ** 2
    return np.where(cos > 0, cos * alpha * alpha / np.pi / (spread * spread), 0).astype(cos.dtype)
