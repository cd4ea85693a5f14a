"""Divided by the sum of all pixels' weights."""

import numpy as np

FUNCTION = "resolve"
CAUGHT_BY = "mean"
MISTAKE = "divided-by-all-weights"
SAYS = "You divide by the sum of all weights of the picture; each pixel has a sum of its own."


def resolve(radiance, weights):
    """Weighted mean of the samples."""
    if np.ndim(radiance) != 3 or len(radiance) != 3:
        raise ValueError(f"radiance must have shape (3, n, s), got {np.shape(radiance)}")
    if np.shape(weights) != np.shape(radiance)[1:]:
        raise ValueError(f"weights must be {np.shape(radiance)[1:]}, got {np.shape(weights)}")
    total = weights.sum()
    if total == 0:
        return radiance.sum(axis=2) / max(radiance.shape[2], 1)
    return (radiance * weights).sum(axis=2) / total
