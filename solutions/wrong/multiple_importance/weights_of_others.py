"""What is left to 1."""

import numpy as np

FUNCTION = "heuristic_weights"
CAUGHT_BY = "values"
MISTAKE = "shares-of-the-others"
SAYS = "You give each strategy the share of all the others."


def heuristic_weights(counts, densities, exponent):
    """With a mistake."""
    _check_strategies("counts", counts, densities)
    if not exponent >= 1:
        raise ValueError(f"exponent must be >= 1, got {exponent}")
    drawn = np.asarray(counts, np.float64)[:, None] * densities
    largest = drawn.max(axis=0)
    power = (drawn / np.where(largest > 0, largest, 1)) ** float(exponent)
    share = power / np.where(largest > 0, power.sum(axis=0), 1)
    others = np.where(largest > 0, 1 - share, 0) / max(len(drawn) - 1, 1)
    return others.astype(densities.dtype)
