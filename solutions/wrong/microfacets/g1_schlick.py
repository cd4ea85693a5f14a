"""That is Schlick's approximation: Smith's formula is as short."""

import numpy as np

FUNCTION = "smith_g1"
CAUGHT_BY = "values"
MISTAKE = "schlick-masking"
SAYS = "That is Schlick's approximation: Smith's formula is as short."


def smith_g1(cos, alpha):
    """With a mistake."""
    _check(alpha, cos=(cos, "N"))
    up = np.maximum(cos, 0)
    return (up / (up * (1 - alpha / 2) + alpha / 2)).astype(cos.dtype)
