"""The formula as it is written: for the smallest sigma its square is zero."""

import numpy as np

FUNCTION = "gaussian_weights"
CAUGHT_BY = "extremes"
MISTAKE = None


def gaussian_weights(offsets, sigma=1 / 6):
    """Gaussian of the distance to the pixel's centre."""
    _check_gaussian(offsets, sigma)
    r2 = (offsets[0] - 0.5) ** 2 + (offsets[1] - 0.5) ** 2
    with np.errstate(all="ignore"):
        return np.exp(-r2 / offsets.dtype.type(2 * float(sigma) * float(sigma)))


def _check_gaussian(offsets, sigma):
    if not sigma > 0:
        raise ValueError(f"sigma must be > 0, got {sigma}")
    if np.ndim(offsets) != 3 or len(offsets) != 2:
        raise ValueError(f"offsets must have shape (2, n, s), got {np.shape(offsets)}")
