"""The red number for all channels."""

import numpy as np

FUNCTION = "quantize"
CAUGHT_BY = "values"
MISTAKE = "one-number-a-pixel"
SAYS = "All channels of a pixel take the first number: each has its own."


def quantize(encoded, u):
    """With a mistake."""
    _check_batch("encoded", encoded, 3)
    if np.shape(u) != np.shape(encoded):
        raise ValueError(f"u must have the shape {np.shape(encoded)}, got {np.shape(u)}")
    return np.clip(np.floor(255 * encoded.astype(float) + u[0]), 0, 255).astype(np.uint8)
