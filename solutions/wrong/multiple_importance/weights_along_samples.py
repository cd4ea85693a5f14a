"""The sum along the other axis."""

import numpy as np

FUNCTION = "heuristic_weights"
CAUGHT_BY = "values"
MISTAKE = "sum-along-the-samples"
SAYS = "You sum along the samples: weights of one sample, over all strategies, add up to 1."


def heuristic_weights(counts, densities, exponent):
    """With a mistake."""
    _check_strategies("counts", counts, densities)
    if not exponent >= 1:
        raise ValueError(f"exponent must be >= 1, got {exponent}")
    drawn = np.asarray(counts, np.float64)[:, None] * densities
    largest = drawn.max(axis=0)
    power = (drawn / np.where(largest > 0, largest, 1)) ** float(exponent)
    total = power.sum(axis=1)[:, None]
    return (power / np.where(total > 0, total, 1)).astype(densities.dtype)
