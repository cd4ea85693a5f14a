"""White wraps to 0."""

import numpy as np

FUNCTION = "quantize"
CAUGHT_BY = "ends"
MISTAKE = "wraps"
SAYS = "Beyond 255 your codes begin again at 0."


def quantize(encoded, u):
    """With a mistake."""
    _check_batch("encoded", encoded, 3)
    if np.shape(u) != np.shape(encoded):
        raise ValueError(f"u must have the shape {np.shape(encoded)}, got {np.shape(u)}")
    return (np.floor(255 * encoded.astype(float) + u + 1e-6).astype(int) % 256).astype(np.uint8)
