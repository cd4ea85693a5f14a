"""Powers are taken in double precision, which large exponents leave."""

import numpy as np

FUNCTION = "heuristic_weights"
CAUGHT_BY = "steep"
MISTAKE = None


def heuristic_weights(counts, densities, exponent):
    """With a mistake."""
    _check_strategies("counts", counts, densities)
    if not exponent >= 1:
        raise ValueError(f"exponent must be >= 1, got {exponent}")
    drawn = np.asarray(counts, np.float64)[:, None] * densities
    power = drawn ** float(exponent)
    largest = power.sum(axis=0)
    return (power / np.where(largest > 0, power.sum(axis=0), 1)).astype(densities.dtype)
