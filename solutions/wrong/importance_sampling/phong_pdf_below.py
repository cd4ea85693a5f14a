"""Even powers of negative cosines."""

import numpy as np

FUNCTION = "phong_lobe_pdf"
CAUGHT_BY = "below"
MISTAKE = "lobe-below-horizon"
SAYS = "Below the horizon your density is not 0; even powers hide the sign of the cosine."


def phong_lobe_pdf(cos, exponent):
    """With a mistake."""
    _check_numbers("cos", cos)
    if not exponent >= 0:
        raise ValueError(f"exponent must be >= 0, got {exponent}")
    exponent = cos.dtype.type(min(exponent, 1e38))
    scale = (exponent / 2 + 0.5) / cos.dtype.type(np.pi)
    return scale * np.abs(cos) ** exponent
