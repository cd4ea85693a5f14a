"""Sigma where sigma squared belongs."""

import numpy as np

FUNCTION = "gaussian_weights"
CAUGHT_BY = "formula"
MISTAKE = "sigma-as-variance"
SAYS = "You use sigma where its square belongs: sigma is the standard deviation, not the variance."


def gaussian_weights(offsets, sigma=1 / 6):
    """Gaussian of the distance to the pixel's centre."""
    _check_gaussian(offsets, sigma)
    dx, dy = offsets - 0.5
    return np.exp(-(dx * dx + dy * dy) / (2 * float(sigma)))


def _check_gaussian(offsets, sigma):
    if not sigma > 0:
        raise ValueError(f"sigma must be > 0, got {sigma}")
    if np.ndim(offsets) != 3 or len(offsets) != 2:
        raise ValueError(f"offsets must have shape (2, n, s), got {np.shape(offsets)}")
