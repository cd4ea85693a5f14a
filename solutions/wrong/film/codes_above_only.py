"""The upper code comes only where u is over 1 - f."""

import numpy as np

FUNCTION = "quantize"
CAUGHT_BY = "border"
MISTAKE = None


def quantize(encoded, u):
    """With a mistake."""
    _check_batch("encoded", encoded)
    _check_batch("u", u)
    if len(u[0]) != len(encoded[0]):
        raise ValueError(f"u must have shape {np.shape(encoded)}, got {np.shape(u)}")
    return (
        np.minimum(np.ceil(255 * encoded.astype(np.float64) + u) - 1, 255).clip(0).astype(np.uint8)
    )
