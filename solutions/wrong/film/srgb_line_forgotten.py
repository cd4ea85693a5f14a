"""The root alone."""

import numpy as np

FUNCTION = "encode_srgb"
CAUGHT_BY = "dark"
MISTAKE = "no-line"
SAYS = "You leave out the line next to black."


def encode_srgb(linear):
    """With a mistake."""
    _check_batch("linear", linear)
    x = np.clip(linear, 0, 1)
    return np.where(
        x <= 0.0031308,
        np.maximum(1.055 * x ** (1 / 2.4) - 0.055, 0),
        1.055 * x ** (1 / 2.4) - 0.055,
    ).astype(linear.dtype)
