"""The reflectance's factor, exponent + 2."""

import numpy as np

FUNCTION = "phong_lobe_pdf"
CAUGHT_BY = "values"
MISTAKE = "reflectance-for-density"
SAYS = "You divide by the integral of cos^(n + 1): that belongs to the reflectance, not to the density."


def phong_lobe_pdf(cos, exponent):
    """With a mistake."""
    _check_numbers("cos", cos)
    if not exponent >= 0:
        raise ValueError(f"exponent must be >= 0, got {exponent}")
    exponent = cos.dtype.type(min(exponent, 1e38))
    scale = (exponent / 2 + 1) / cos.dtype.type(np.pi)
    return np.where(cos < 0, 0, scale * np.clip(cos, 0, 1) ** exponent)
