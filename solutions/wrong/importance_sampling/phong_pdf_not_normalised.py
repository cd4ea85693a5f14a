"""The power itself."""

import numpy as np

FUNCTION = "phong_lobe_pdf"
CAUGHT_BY = "values"
MISTAKE = "lobe-not-normalised"
SAYS = "Your density is the power of the cosine itself: its integral is not 1."


def phong_lobe_pdf(cos, exponent):
    """With a mistake."""
    _check_numbers("cos", cos)
    if not exponent >= 0:
        raise ValueError(f"exponent must be >= 0, got {exponent}")
    exponent = cos.dtype.type(min(exponent, 1e38))
    return np.where(cos < 0, 0, np.clip(cos, 0, 1) ** exponent)
