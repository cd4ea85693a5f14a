"""Powers in single precision."""

import numpy as np

FUNCTION = "heuristic_weights"
CAUGHT_BY = "extremes"
MISTAKE = None


def heuristic_weights(counts, densities, exponent):
    """With a mistake."""
    _check_strategies("counts", counts, densities)
    if not exponent >= 1:
        raise ValueError(f"exponent must be >= 1, got {exponent}")
    with np.errstate(all="ignore"):
        power = (
            np.asarray(counts, np.float32)[:, None] * densities.astype(np.float32)
        ) ** np.float32(exponent)
        total = power.sum(axis=0)
        found = power / np.where(total > 0, total, 1)
    return np.nan_to_num(found).astype(densities.dtype)
