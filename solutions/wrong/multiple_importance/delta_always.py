"""Deltas of probability 0 count."""

import numpy as np

FUNCTION = "delta_weights"
CAUGHT_BY = "elsewhere"
MISTAKE = "delta-takes-what-it-cannot-draw"
SAYS = "A delta of probability 0 doesn't draw the sample: it takes nothing from the others."


def delta_weights(counts, densities, delta):
    """With a mistake."""
    _check_strategies("counts", counts, densities)
    if np.shape(delta) != np.shape(densities):
        raise ValueError(f"delta must have shape {np.shape(densities)}, got {np.shape(delta)}")
    drawn = np.asarray(counts, np.float64)[:, None] * densities
    drawn = np.where(delta.any(axis=0) & ~np.asarray(delta, bool), 0, drawn)
    total = drawn.sum(axis=0)
    return (drawn / np.where(total > 0, total, 1)).astype(densities.dtype)
