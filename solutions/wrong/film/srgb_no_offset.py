"""Without - 0.055."""

import numpy as np

FUNCTION = "encode_srgb"
CAUGHT_BY = "ends"
MISTAKE = "no-offset"
SAYS = "You leave out the 0.055 that is taken off."


def encode_srgb(linear):
    """With a mistake."""
    _check_batch("linear", linear)
    x = np.clip(linear, 0, 1)
    return np.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4)).astype(linear.dtype)
