"""The balance heuristic, whatever the exponent."""

import numpy as np

FUNCTION = "heuristic_weights"
CAUGHT_BY = "values"
MISTAKE = "always-balance"
SAYS = "You leave the exponent out: that is the balance heuristic for all of them."


def heuristic_weights(counts, densities, exponent):
    """With a mistake."""
    _check_strategies("counts", counts, densities)
    if not exponent >= 1:
        raise ValueError(f"exponent must be >= 1, got {exponent}")
    drawn = np.asarray(counts, np.float64)[:, None] * densities
    largest = drawn.max(axis=0)
    power = drawn / np.where(largest > 0, largest, 1)
    return (power / np.where(largest > 0, power.sum(axis=0), 1)).astype(densities.dtype)
