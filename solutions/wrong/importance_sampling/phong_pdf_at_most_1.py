"""A density that is never over 1."""

import numpy as np

FUNCTION = "phong_lobe_pdf"
CAUGHT_BY = "sharp"
MISTAKE = "density-at-most-1"
SAYS = "You keep the density from exceeding 1; only probabilities end there."


def phong_lobe_pdf(cos, exponent):
    """With a mistake."""
    _check_numbers("cos", cos)
    if not exponent >= 0:
        raise ValueError(f"exponent must be >= 0, got {exponent}")
    density = (exponent + 1) / (2 * np.pi) * np.maximum(cos, 0) ** float(exponent)
    return np.where(cos < 0, 0, np.minimum(density, 1)).astype(cos.dtype)
