"""A small number in the sum."""

import numpy as np

FUNCTION = "heuristic_weights"
CAUGHT_BY = "extremes"
MISTAKE = None


def heuristic_weights(counts, densities, exponent):
    """With a mistake."""
    _check_strategies("counts", counts, densities)
    if not exponent >= 1:
        raise ValueError(f"exponent must be >= 1, got {exponent}")
    drawn = np.asarray(counts, np.float64)[:, None] * densities
    power = drawn ** float(exponent)
    with np.errstate(all="ignore"):
        return np.nan_to_num(power / (power.sum(axis=0) + 1e-10)).astype(densities.dtype)
