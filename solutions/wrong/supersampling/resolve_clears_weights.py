"""Writes ones into the caller's weights where they are all zero."""

import numpy as np

FUNCTION = "resolve"
CAUGHT_BY = "untouched"
MISTAKE = "writes-to-arguments"


def resolve(radiance, weights):
    """Weighted mean of the samples."""
    _check_resolve(radiance, weights)
    weights[weights.sum(axis=1) == 0] = 1
    total = weights.sum(axis=1)
    if radiance.shape[2] == 0:
        total = total + 1
    return (radiance * weights).sum(axis=2) / total


def _check_resolve(radiance, weights):
    if np.ndim(radiance) != 3 or len(radiance) != 3:
        raise ValueError(f"radiance must have shape (3, n, s), got {np.shape(radiance)}")
    if np.shape(weights) != np.shape(radiance)[1:]:
        raise ValueError(f"weights must be {np.shape(radiance)[1:]}, got {np.shape(weights)}")
