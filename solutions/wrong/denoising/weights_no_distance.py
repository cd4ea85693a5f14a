"""The distance doesn't count for you."""

import numpy as np

FUNCTION = "pair_weights"
CAUGHT_BY = "values"
MISTAKE = "distance-left-out"
SAYS = "The distance doesn't count for you."


def pair_weights(t, critical, distance, sigma):
    """With a mistake."""
    _check("t", t, 3, "N")
    pixels = np.shape(t)[1]
    _check("critical", critical, 3, pixels)
    _check("distance", distance, pixels)
    if not sigma > 0:
        raise ValueError(f"sigma must be > 0, got {sigma}")
    joined = (np.abs(t) <= critical).all(axis=0)
    weights = joined * np.ones_like(distance)
    return weights.astype(_dtype(t, critical, distance))
