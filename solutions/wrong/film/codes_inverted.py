"""Upper code where u is less than f."""

import numpy as np

FUNCTION = "quantize"
CAUGHT_BY = "values"
MISTAKE = "less-than-f"
SAYS = "You take the upper code where u < f: it comes where u is at least 1 - f."


def quantize(encoded, u):
    """With a mistake."""
    _check_batch("encoded", encoded, 3)
    if np.shape(u) != np.shape(encoded):
        raise ValueError(f"u must have the shape {np.shape(encoded)}, got {np.shape(u)}")
    x = 255 * encoded.astype(float)
    low = np.floor(x)
    return (low + (u < x - low)).astype(np.uint8)
