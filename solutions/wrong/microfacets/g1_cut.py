"""Cosines under a hundredth count as 0, so that nothing large is made of them."""

import numpy as np

FUNCTION = "smith_g1"
CAUGHT_BY = "slanting"
MISTAKE = None

_right = smith_g1


def smith_g1(cos, alpha):
    """With a mistake."""
    return np.where(cos > 0.01, _right(cos, alpha), 0).astype(cos.dtype)
