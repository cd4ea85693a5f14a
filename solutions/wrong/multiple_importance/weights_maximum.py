"""The maximum heuristic."""

import numpy as np

FUNCTION = "heuristic_weights"
CAUGHT_BY = "values"
MISTAKE = "the-densest-takes-all"
SAYS = "The densest strategy gets all: that is the maximum heuristic."


def heuristic_weights(counts, densities, exponent):
    """With a mistake."""
    _check_strategies("counts", counts, densities)
    if not exponent >= 1:
        raise ValueError(f"exponent must be >= 1, got {exponent}")
    drawn = np.asarray(counts, np.float64)[:, None] * densities
    best = (drawn == drawn.max(axis=0)) & (drawn > 0)
    return (best / np.maximum(best.sum(axis=0), 1)).astype(densities.dtype)
