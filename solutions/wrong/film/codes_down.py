"""Rounded down."""

import numpy as np

FUNCTION = "quantize"
CAUGHT_BY = "unbiased"
MISTAKE = "rounded-down"
SAYS = "You round down: u decides which of the two codes it is."


def quantize(encoded, u):
    """With a mistake."""
    _check_batch("encoded", encoded, 3)
    if np.shape(u) != np.shape(encoded):
        raise ValueError(f"u must have the shape {np.shape(encoded)}, got {np.shape(u)}")
    return np.floor(255 * encoded.astype(float)).astype(np.uint8)
