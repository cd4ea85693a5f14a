"""Densities keep their share beside deltas."""

import numpy as np

FUNCTION = "delta_weights"
CAUGHT_BY = "values"
MISTAKE = "densities-beside-a-delta"
SAYS = "Where a delta draws the sample, densities have no share."


def delta_weights(counts, densities, delta):
    """With a mistake."""
    _check_strategies("counts", counts, densities)
    if np.shape(delta) != np.shape(densities):
        raise ValueError(f"delta must have shape {np.shape(densities)}, got {np.shape(delta)}")
    drawn = np.asarray(counts, np.float64)[:, None] * densities
    certain = delta & (drawn > 0)
    total = drawn.sum(axis=0)
    found = np.where(certain, 1, drawn / np.where(total > 0, total, 1))
    return found.astype(densities.dtype)
