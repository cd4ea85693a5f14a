"""You have microfacets that look down: their cosine is below 0, and its square does not tell."""

import numpy as np

FUNCTION = "ggx"
CAUGHT_BY = "below"
MISTAKE = "looks-down"
SAYS = "You have microfacets that look down: their cosine is below 0, and its square does not tell."


def ggx(cos, alpha):
    """With a mistake."""
    _check(alpha, cos=(cos, "N"))
    spread = (1 - cos) * (1 + cos) + (alpha * cos) ** 2
    return (alpha * alpha / np.pi / (spread * spread)).astype(cos.dtype)
