"""Each pixel's weights are made to sum to 1."""

import numpy as np

FUNCTION = "gaussian_weights"
CAUGHT_BY = "formula"
MISTAKE = "normalised-already"
SAYS = "You make each pixel's weights sum to 1; that is left to resolve, and here the middle has weight 1."


def gaussian_weights(offsets, sigma=1 / 6):
    """Gaussian of the distance to the pixel's centre."""
    if not sigma > 0:
        raise ValueError(f"sigma must be > 0, got {sigma}")
    if np.ndim(offsets) != 3 or len(offsets) != 2:
        raise ValueError(f"offsets must have shape (2, n, s), got {np.shape(offsets)}")
    x, y = offsets - 0.5
    weights = np.exp(-(x**2 + y**2) / float(2 * sigma**2))
    total = weights.sum(axis=1, keepdims=True)
    return weights / np.where(total > 0, total, 1)
