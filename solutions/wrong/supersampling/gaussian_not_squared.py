"""The distance is not squared: a peak with a kink."""

import numpy as np

FUNCTION = "gaussian_weights"
CAUGHT_BY = "formula"
MISTAKE = "distance-not-squared"
SAYS = "The distance in your exponent is not squared, which gives a peak with a kink, not a bell."


def gaussian_weights(offsets, sigma=1 / 6):
    """Gaussian of the distance to the pixel's centre."""
    if not sigma > 0:
        raise ValueError(f"sigma must be > 0, got {sigma}")
    if np.ndim(offsets) != 3 or len(offsets) != 2:
        raise ValueError(f"offsets must have shape (2, n, s), got {np.shape(offsets)}")
    r = np.hypot(offsets[0] - 0.5, offsets[1] - 0.5)
    sigma = max(float(sigma), 1e-9)
    return np.exp(-r / (2 * sigma**2))
