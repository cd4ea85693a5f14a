"""256 encoded."""

import numpy as np

FUNCTION = "quantize"
CAUGHT_BY = "neighbours"
MISTAKE = "256-steps"
SAYS = "You multiply by 256: white is 255."


def quantize(encoded, u):
    """With a mistake."""
    _check_batch("encoded", encoded, 3)
    if np.shape(u) != np.shape(encoded):
        raise ValueError(f"u must have the shape {np.shape(encoded)}, got {np.shape(u)}")
    return np.clip(np.floor(256 * encoded.astype(float) + u), 0, 255).astype(np.uint8)
