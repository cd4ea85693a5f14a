"""Negative below the horizon."""

import numpy as np

FUNCTION = "cosine_hemisphere_pdf"
CAUGHT_BY = "below"
MISTAKE = "cosine-below-horizon"
SAYS = "Below the horizon your density is not 0."


def cosine_hemisphere_pdf(cos):
    """With a mistake."""
    _check_numbers("cos", cos)
    return cos / cos.dtype.type(np.pi)
