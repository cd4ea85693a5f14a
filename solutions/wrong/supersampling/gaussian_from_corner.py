"""Distance from the pixel's corner, not from its centre."""

import numpy as np

FUNCTION = "gaussian_weights"
CAUGHT_BY = "default"
MISTAKE = "from-corner"
SAYS = (
    "You measure the distance from the pixel's corner; the weight should be largest in its middle."
)


def gaussian_weights(offsets, sigma=1 / 6):
    """Gaussian of the distance to the pixel's centre."""
    _check_gaussian(offsets, sigma)
    r2 = offsets[0] ** 2 + offsets[1] ** 2
    return np.exp(-r2 / (2 * float(sigma) ** 2))


def _check_gaussian(offsets, sigma):
    if not sigma > 0:
        raise ValueError(f"sigma must be > 0, got {sigma}")
    if np.ndim(offsets) != 3 or len(offsets) != 2:
        raise ValueError(f"offsets must have shape (2, n, s), got {np.shape(offsets)}")
