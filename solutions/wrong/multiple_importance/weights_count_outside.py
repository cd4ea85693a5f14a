"""Counts outside the power."""

import numpy as np

FUNCTION = "heuristic_weights"
CAUGHT_BY = "values"
MISTAKE = "counts-outside-the-power"
SAYS = "The counts belong within the power: (n p)^exponent."


def heuristic_weights(counts, densities, exponent):
    """With a mistake."""
    _check_strategies("counts", counts, densities)
    if not exponent >= 1:
        raise ValueError(f"exponent must be >= 1, got {exponent}")
    counts = np.asarray(counts, np.float64)[:, None]
    drawn = np.where(counts > 0, densities, 0)
    largest = drawn.max(axis=0)
    power = counts * (drawn / np.where(largest > 0, largest, 1)) ** float(exponent)
    return (power / np.where(largest > 0, power.sum(axis=0), 1)).astype(densities.dtype)
