"""Divided by the number of samples, not by the sum of the weights."""

import numpy as np

FUNCTION = "resolve"
CAUGHT_BY = "scale"
MISTAKE = "divided-by-count"
SAYS = "You divide by the number of samples; it should be by the sum of their weights."


def resolve(radiance, weights):
    """Weighted mean of the samples."""
    _check_resolve(radiance, weights)
    total = np.zeros(radiance.shape[:2], np.result_type(radiance, weights))
    for i in range(radiance.shape[2]):
        total += radiance[:, :, i] * weights[:, i]
    return total / max(radiance.shape[2], 1)


def _check_resolve(radiance, weights):
    if np.ndim(radiance) != 3 or len(radiance) != 3:
        raise ValueError(f"radiance must have shape (3, n, s), got {np.shape(radiance)}")
    if np.shape(weights) != np.shape(radiance)[1:]:
        raise ValueError(f"weights must be {np.shape(radiance)[1:]}, got {np.shape(weights)}")
