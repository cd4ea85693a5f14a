"""Densities below 1e-9 draw nothing."""

import numpy as np

FUNCTION = "delta_weights"
CAUGHT_BY = "sizes"
MISTAKE = None


def delta_weights(counts, densities, delta):
    """With a mistake."""
    _check_strategies("counts", counts, densities)
    _check("delta", delta, *np.shape(densities))
    drawn = np.asarray(counts, np.float64)[:, None] * densities
    certain = delta & (drawn > 0)
    drawn = np.where(certain.any(axis=0) & ~certain, 0, drawn)
    total = drawn.sum(axis=0)
    return (drawn / np.where(total > 1e-9, total, 1)).astype(densities.dtype)
