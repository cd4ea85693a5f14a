"""The sum below is to be squared."""

import numpy as np

FUNCTION = "ggx"
CAUGHT_BY = "values"
MISTAKE = "sum-not-squared"
SAYS = "The sum below is to be squared."


def ggx(cos, alpha):
    """With a mistake."""
    _check(alpha, cos=(cos, "N"))
    spread = (1 - cos) * (1 + cos) + (alpha * cos) ** 2
    return np.where(cos > 0, alpha * alpha / np.pi / spread, 0).astype(cos.dtype)
