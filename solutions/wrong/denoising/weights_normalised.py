"""You divide the Gaussian by its integral; a pixel's own weight is 1."""

import numpy as np

FUNCTION = "pair_weights"
CAUGHT_BY = "own"
MISTAKE = "gaussian-over-its-integral"
SAYS = "You divide the Gaussian by its integral; a pixel's own weight is 1."


def pair_weights(t, critical, distance, sigma):
    """With a mistake."""
    _check("t", t, 3, "N")
    pixels = np.shape(t)[1]
    _check("critical", critical, 3, pixels)
    _check("distance", distance, pixels)
    if not sigma > 0:
        raise ValueError(f"sigma must be > 0, got {sigma}")
    joined = (np.abs(t) <= critical).all(axis=0)
    weights = joined * np.exp(-0.5 * (distance / sigma) ** 2) / (2 * np.pi * sigma**2)
    return weights.astype(_dtype(t, critical, distance))
