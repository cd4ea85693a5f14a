"""Samples below 0 are taken for 0."""

import numpy as np

FUNCTION = "resolve"
CAUGHT_BY = "bright"
MISTAKE = "cut-at-zero"
SAYS = "Samples below 0 are taken for 0, though they are meant to cancel others."


def resolve(radiance, weights):
    """Weighted mean of the samples."""
    if np.ndim(radiance) != 3 or len(radiance) != 3:
        raise ValueError(f"radiance must have shape (3, n, s), got {np.shape(radiance)}")
    if np.shape(weights) != np.shape(radiance)[1:]:
        raise ValueError(f"weights must be {np.shape(radiance)[1:]}, got {np.shape(weights)}")
    dtype = np.result_type(radiance, weights)
    radiance = np.maximum(radiance, 0)
    weights = np.where(weights.sum(axis=1, keepdims=True) == 0, 1, weights)
    total = np.where(weights.sum(axis=1) == 0, 1, weights.sum(axis=1))
    return ((radiance * weights).sum(axis=2) / total).astype(dtype)
