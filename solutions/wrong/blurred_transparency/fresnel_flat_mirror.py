"""From a hundredth down the cosine counts as 0."""

import numpy as np

FUNCTION = "fresnel"
CAUGHT_BY = "slanting"
MISTAKE = None

_right = fresnel


def fresnel(cos_i, eta):
    """With a mistake."""
    return np.where(cos_i < 0.01, 1, found := _right(cos_i, eta)).astype(found.dtype)
