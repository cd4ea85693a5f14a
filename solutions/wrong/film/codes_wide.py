"""Noise of two codes."""

import numpy as np

FUNCTION = "quantize"
CAUGHT_BY = "neighbours"
MISTAKE = "two-codes-wide"
SAYS = "Your noise is two codes wide."


def quantize(encoded, u):
    """With a mistake."""
    _check_batch("encoded", encoded, 3)
    if np.shape(u) != np.shape(encoded):
        raise ValueError(f"u must have the shape {np.shape(encoded)}, got {np.shape(u)}")
    return np.clip(np.floor(255 * encoded.astype(float) + 2 * u - 0.5), 0, 255).astype(np.uint8)
