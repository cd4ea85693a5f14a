"""Powers of negative cosines as they come."""

import numpy as np

FUNCTION = "phong_lobe_pdf"
CAUGHT_BY = "below"
MISTAKE = "lobe-below-horizon"


def phong_lobe_pdf(cos, exponent):
    """With a mistake."""
    _check_numbers("cos", cos)
    if not exponent >= 0:
        raise ValueError(f"exponent must be >= 0, got {exponent}")
    with np.errstate(invalid="ignore"):
        return ((exponent + 1) / (2 * np.pi) * cos**exponent).astype(cos.dtype)
