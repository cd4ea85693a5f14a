"""The curve backwards."""

import numpy as np

FUNCTION = "encode_srgb"
CAUGHT_BY = "values"
MISTAKE = "decoded"
SAYS = "You decode: the result is to be brighter than the radiance."


def encode_srgb(linear):
    """With a mistake."""
    _check_batch("linear", linear)
    x = np.clip(linear, 0, 1)
    return np.where(x <= 0.04045, x / 12.92, ((x + 0.055) / 1.055) ** 2.4).astype(linear.dtype)
