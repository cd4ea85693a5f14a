"""That is the distribution of Beckmann, whose tails are shorter."""

import numpy as np

FUNCTION = "ggx"
CAUGHT_BY = "values"
MISTAKE = "beckmann"
SAYS = "That is the distribution of Beckmann, whose tails are shorter."


def ggx(cos, alpha):
    """With a mistake."""
    _check(alpha, cos=(cos, "N"))
    return np.where(
        cos > 0,
        np.exp(-(1 - cos * cos) / np.maximum((alpha * cos) ** 2, 1e-3))
        / (np.pi * alpha**2 * np.maximum(cos, 1e-3) ** 4),
        0,
    ).astype(cos.dtype)
