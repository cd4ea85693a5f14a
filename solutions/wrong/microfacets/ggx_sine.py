"""You took the square of the sine for that of the cosine: most microfacets stand upright."""

import numpy as np

FUNCTION = "ggx"
CAUGHT_BY = "values"
MISTAKE = "sine-for-cosine"
SAYS = "You took the square of the sine for that of the cosine: most microfacets stand upright."


def ggx(cos, alpha):
    """With a mistake."""
    _check(alpha, cos=(cos, "N"))
    spread = cos * cos + alpha * alpha * (1 - cos * cos)
    return np.where(cos > 0, alpha * alpha / np.pi / (spread * spread), 0).astype(cos.dtype)
