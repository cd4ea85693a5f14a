"""Without sigma it is half a pixel."""

import numpy as np

FUNCTION = "gaussian_weights"
CAUGHT_BY = "default"
MISTAKE = None


def gaussian_weights(offsets, sigma=1 / 2):
    """Gaussian of the distance to the pixel's centre."""
    if not sigma > 0:
        raise ValueError(f"sigma must be > 0, got {sigma}")
    if np.ndim(offsets) != 3 or len(offsets) != 2:
        raise ValueError(f"offsets must have shape (2, n, s), got {np.shape(offsets)}")
    x, y = offsets - 0.5
    return np.exp(-(x**2 + y**2) / float(2 * sigma**2))
