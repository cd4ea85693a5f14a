"""The distance along x alone."""

import numpy as np

FUNCTION = "gaussian_weights"
CAUGHT_BY = "formula"
MISTAKE = "one-axis"
SAYS = "You measure the distance along one axis only, which gives stripes: both count."


def gaussian_weights(offsets, sigma=1 / 6):
    """Gaussian of the distance to the pixel's centre."""
    if not sigma > 0:
        raise ValueError(f"sigma must be > 0, got {sigma}")
    if np.ndim(offsets) != 3 or len(offsets) != 2:
        raise ValueError(f"offsets must have shape (2, n, s), got {np.shape(offsets)}")
    return np.exp(-((offsets[0] - 0.5) ** 2) / float(2 * sigma**2))
