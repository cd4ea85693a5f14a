"""Whole exponents only."""

import numpy as np

FUNCTION = "phong_lobe_pdf"
CAUGHT_BY = "values"
MISTAKE = "whole-exponents"
SAYS = "The exponent is rounded to a whole number."


def phong_lobe_pdf(cos, exponent):
    """With a mistake."""
    _check_numbers("cos", cos)
    if not exponent >= 0:
        raise ValueError(f"exponent must be >= 0, got {exponent}")
    exponent = int(exponent)
    density = (exponent + 1) / (2 * np.pi) * np.maximum(cos, 0) ** exponent
    return np.where(cos < 0, 0, density).astype(cos.dtype)
