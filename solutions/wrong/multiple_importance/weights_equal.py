"""Equal weights of all that can draw a sample."""

import numpy as np

FUNCTION = "heuristic_weights"
CAUGHT_BY = "values"
MISTAKE = "all-alike"
SAYS = "You weigh all strategies alike: the variance of the worse one stays."


def heuristic_weights(counts, densities, exponent):
    """With a mistake."""
    _check_strategies("counts", counts, densities)
    if not exponent >= 1:
        raise ValueError(f"exponent must be >= 1, got {exponent}")
    drawn = np.asarray(counts, np.float64)[:, None] * densities
    able = drawn > 0
    return (able / np.maximum(able.sum(axis=0), 1)).astype(densities.dtype)
