"""Without counts."""

import numpy as np

FUNCTION = "delta_weights"
CAUGHT_BY = "values"
MISTAKE = "delta-counts-left-out"
SAYS = "You leave the counts out."


def delta_weights(counts, densities, delta):
    """With a mistake."""
    _check_strategies("counts", counts, densities)
    if np.shape(delta) != np.shape(densities):
        raise ValueError(f"delta must have shape {np.shape(densities)}, got {np.shape(delta)}")
    drawn = np.where(np.asarray(counts)[:, None] > 0, densities, 0).astype(np.float64)
    certain = delta & (drawn > 0)
    drawn = np.where(certain.any(axis=0) & ~certain, 0, drawn)
    total = drawn.sum(axis=0)
    return (drawn / np.where(total > 0, total, 1)).astype(densities.dtype)
