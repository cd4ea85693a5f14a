"""A delta that takes no samples still takes the weight of the others."""

import numpy as np

FUNCTION = "delta_weights"
CAUGHT_BY = "elsewhere"
MISTAKE = None


def delta_weights(counts, densities, delta):
    """With a mistake."""
    _check_strategies("counts", counts, densities)
    _check("delta", delta, *np.shape(densities))
    drawn = np.asarray(counts, np.float64)[:, None] * densities
    certain = delta & (densities > 0)
    drawn = np.where(certain.any(axis=0) & ~certain, 0, drawn)
    total = drawn.sum(axis=0)
    return (drawn / np.where(total > 0, total, 1)).astype(densities.dtype)
