"""The exponent lacks its factor of one half."""

import numpy as np

FUNCTION = "gaussian_weights"
CAUGHT_BY = "formula"
MISTAKE = "half-missing"
SAYS = "Your Gaussian is too narrow by the square root of two: the exponent lacks its factor of one half."


def gaussian_weights(offsets, sigma=1 / 6):
    """Gaussian of the distance to the pixel's centre."""
    _check_gaussian(offsets, sigma)
    r = np.hypot(offsets[0] - 0.5, offsets[1] - 0.5)
    return np.exp(-((r / float(sigma)) ** 2))


def _check_gaussian(offsets, sigma):
    if not sigma > 0:
        raise ValueError(f"sigma must be > 0, got {sigma}")
    if np.ndim(offsets) != 3 or len(offsets) != 2:
        raise ValueError(f"offsets must have shape (2, n, s), got {np.shape(offsets)}")
