"""The knee of the decoding."""

import numpy as np

FUNCTION = "encode_srgb"
CAUGHT_BY = "dark"
MISTAKE = "other-knee"
SAYS = "Your line ends at 0.04045, which is the knee of the encoded values."


def encode_srgb(linear):
    """With a mistake."""
    _check_batch("linear", linear)
    x = np.clip(linear, 0, 1)
    return np.where(x <= 0.04045, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055).astype(linear.dtype)
