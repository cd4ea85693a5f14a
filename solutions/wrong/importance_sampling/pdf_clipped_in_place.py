"""Cosines below the horizon are set to 0 in the array that was handed in."""

import numpy as np

FUNCTION = "cosine_hemisphere_pdf"
CAUGHT_BY = "untouched"
MISTAKE = "writes-to-arguments"

_right = cosine_hemisphere_pdf


def cosine_hemisphere_pdf(cos):
    """With a mistake."""
    _check_numbers("cos", cos)
    if (cos < 0).any():
        cos[cos < 0] = 0
    return np.divide(cos, np.pi, dtype=cos.dtype)
