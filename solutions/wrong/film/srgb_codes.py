"""Codes up to 255."""

import numpy as np

FUNCTION = "encode_srgb"
CAUGHT_BY = "values"
MISTAKE = "codes"
SAYS = "Your values are up to 255: they are to be up to 1."


def encode_srgb(linear):
    """With a mistake."""
    _check_batch("linear", linear)
    x = np.clip(linear, 0, 1)
    return np.where(x <= 0.0031308, 255 * 12.92 * x, 255 * (1.055 * x ** (1 / 2.4) - 0.055)).astype(
        linear.dtype
    )
