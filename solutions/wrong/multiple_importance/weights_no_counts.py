"""Densities alone."""

import numpy as np

FUNCTION = "heuristic_weights"
CAUGHT_BY = "values"
MISTAKE = "counts-left-out"
SAYS = "You leave the counts out: who takes more samples has the larger share."


def heuristic_weights(counts, densities, exponent):
    """With a mistake."""
    _check_strategies("counts", counts, densities)
    if not exponent >= 1:
        raise ValueError(f"exponent must be >= 1, got {exponent}")
    drawn = np.where(np.asarray(counts)[:, None] > 0, densities, 0).astype(np.float64)
    largest = drawn.max(axis=0)
    power = (drawn / np.where(largest > 0, largest, 1)) ** float(exponent)
    return (power / np.where(largest > 0, power.sum(axis=0), 1)).astype(densities.dtype)
