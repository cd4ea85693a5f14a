"""The cosine's size, whatever its sign."""

import numpy as np

FUNCTION = "cosine_hemisphere_pdf"
CAUGHT_BY = "below"
MISTAKE = "mirrored-below-horizon"
SAYS = "Below the horizon your density is that of the mirrored direction; it has to be 0."


def cosine_hemisphere_pdf(cos):
    """With a mistake."""
    _check_numbers("cos", cos)
    return np.abs(cos) / cos.dtype.type(np.pi)
