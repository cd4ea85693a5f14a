"""A power of 1 / 2.2."""

import numpy as np

FUNCTION = "encode_srgb"
CAUGHT_BY = "dark"
MISTAKE = "power-alone"
SAYS = "You take a power alone: next to black the curve is a line."


def encode_srgb(linear):
    """With a mistake."""
    _check_batch("linear", linear)
    x = np.clip(linear, 0, 1)
    return np.where(x <= 0.0031308, x ** (1 / 2.2), x ** (1 / 2.2)).astype(linear.dtype)
