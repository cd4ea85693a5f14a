"""That is the density of slopes: cos^4 is missing."""

import numpy as np

FUNCTION = "ggx"
CAUGHT_BY = "values"
MISTAKE = "density-of-slopes"
SAYS = "That is the density of slopes: cos^4 is missing."


def ggx(cos, alpha):
    """With a mistake."""
    _check(alpha, cos=(cos, "N"))
    spread = (1 - cos) * (1 + cos) + (alpha * cos) ** 2
    return np.where(cos > 0, cos**4 * alpha * alpha / np.pi / (spread * spread), 0).astype(
        cos.dtype
    )
