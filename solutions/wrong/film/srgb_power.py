"""The root of 2.2 in the curve."""

import numpy as np

FUNCTION = "encode_srgb"
CAUGHT_BY = "values"
MISTAKE = "power-of-2.2"
SAYS = "Your root is that of 2.2: with the factor 1.055 it is 2.4."


def encode_srgb(linear):
    """With a mistake."""
    _check_batch("linear", linear)
    x = np.clip(linear, 0, 1)
    return np.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.2) - 0.055).astype(linear.dtype)
