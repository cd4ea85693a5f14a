"""Not cut off at 1."""

import numpy as np

FUNCTION = "encode_srgb"
CAUGHT_BY = "range"
MISTAKE = "white-not-cut"
SAYS = "You do not cut off at white."


def encode_srgb(linear):
    """With a mistake."""
    _check_batch("linear", linear)
    x = np.maximum(linear, 0)
    return np.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055).astype(linear.dtype)
