"""The exponent instead of one more."""

import numpy as np

FUNCTION = "phong_lobe_pdf"
CAUGHT_BY = "values"
MISTAKE = "exponent-off-by-one"
SAYS = "Your density is scaled by the exponent instead of one more."


def phong_lobe_pdf(cos, exponent):
    """With a mistake."""
    _check_numbers("cos", cos)
    if not exponent >= 0:
        raise ValueError(f"exponent must be >= 0, got {exponent}")
    exponent = cos.dtype.type(min(exponent, 1e38))
    scale = exponent / cos.dtype.type(2 * np.pi)
    return np.where(cos < 0, 0, scale * np.clip(cos, 0, 1) ** exponent)
