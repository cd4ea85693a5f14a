"""Not cut off at 0."""

import numpy as np

FUNCTION = "encode_srgb"
CAUGHT_BY = "range"
MISTAKE = "black-not-cut"
SAYS = "You do not cut off at black."


def encode_srgb(linear):
    """With a mistake."""
    _check_batch("linear", linear)
    x = np.minimum(linear, 1)
    return np.where(
        x <= 0.0031308, 12.92 * x, 1.055 * np.maximum(x, 0) ** (1 / 2.4) - 0.055
    ).astype(linear.dtype)
