"""Deltas share evenly."""

import numpy as np

FUNCTION = "delta_weights"
CAUGHT_BY = "values"
MISTAKE = "deltas-share-evenly"
SAYS = "Deltas share by counts times probabilities, not evenly."


def delta_weights(counts, densities, delta):
    """With a mistake."""
    _check_strategies("counts", counts, densities)
    if np.shape(delta) != np.shape(densities):
        raise ValueError(f"delta must have shape {np.shape(densities)}, got {np.shape(delta)}")
    drawn = np.asarray(counts, np.float64)[:, None] * densities
    certain = delta & (drawn > 0)
    drawn = np.where(certain.any(axis=0), certain, drawn)
    total = drawn.sum(axis=0)
    return (drawn / np.where(total > 0, total, 1)).astype(densities.dtype)
