"""Each delta has weight 1."""

import numpy as np

FUNCTION = "delta_weights"
CAUGHT_BY = "values"
MISTAKE = "each-delta-has-weight-1"
SAYS = "Deltas that meet the same sample share the weight: together they have 1."


def delta_weights(counts, densities, delta):
    """With a mistake."""
    _check_strategies("counts", counts, densities)
    if np.shape(delta) != np.shape(densities):
        raise ValueError(f"delta must have shape {np.shape(densities)}, got {np.shape(delta)}")
    drawn = np.asarray(counts, np.float64)[:, None] * densities
    certain = delta & (drawn > 0)
    drawn = np.where(certain.any(axis=0) & ~certain, 0, drawn)
    total = drawn.sum(axis=0)
    found = np.where(certain, 1, drawn / np.where(total > 0, total, 1))
    return found.astype(densities.dtype)
