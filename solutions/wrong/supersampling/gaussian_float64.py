"""Returns float64, whatever came."""

import numpy as np

FUNCTION = "gaussian_weights"
CAUGHT_BY = "contract"
MISTAKE = "gaussian-weights-float64"
SAYS = (
    "Your result is float64; the course's pictures are float32, and so should the result be here."
)


def gaussian_weights(offsets, sigma=1 / 6):
    """Gaussian of the distance to the pixel's centre."""
    if not sigma > 0:
        raise ValueError(f"sigma must be > 0, got {sigma}")
    if np.ndim(offsets) != 3 or len(offsets) != 2:
        raise ValueError(f"offsets must have shape (2, n, s), got {np.shape(offsets)}")
    x, y = np.float64(offsets) - 0.5
    return np.exp(-(x**2 + y**2) / (2 * sigma**2))
