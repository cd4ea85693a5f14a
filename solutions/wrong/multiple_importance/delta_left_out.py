"""Deltas get nothing."""

import numpy as np

FUNCTION = "delta_weights"
CAUGHT_BY = "mirror"
MISTAKE = "delta-left-out"
SAYS = "You leave deltas out, and what they draw is lost."


def delta_weights(counts, densities, delta):
    """With a mistake."""
    _check_strategies("counts", counts, densities)
    if np.shape(delta) != np.shape(densities):
        raise ValueError(f"delta must have shape {np.shape(densities)}, got {np.shape(delta)}")
    drawn = np.where(delta, 0, np.asarray(counts, np.float64)[:, None] * densities)
    total = drawn.sum(axis=0)
    return (drawn / np.where(total > 0, total, 1)).astype(densities.dtype)
