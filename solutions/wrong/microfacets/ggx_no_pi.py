"""Your D has no pi in it: the microfacets cover the surface pi times."""

import numpy as np

FUNCTION = "ggx"
CAUGHT_BY = "values"
MISTAKE = "no-pi"
SAYS = "Your D has no pi in it: the microfacets cover the surface pi times."


def ggx(cos, alpha):
    """With a mistake."""
    _check(alpha, cos=(cos, "N"))
    spread = (1 - cos) * (1 + cos) + (alpha * cos) ** 2
    return np.where(cos > 0, alpha * alpha / (spread * spread), 0).astype(cos.dtype)
