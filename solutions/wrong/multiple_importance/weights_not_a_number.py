"""0 / 0 where nobody draws."""

import numpy as np

FUNCTION = "heuristic_weights"
CAUGHT_BY = "nobody"
MISTAKE = "nobody-is-nan"
SAYS = "Where no strategy draws a sample you divide 0 by 0."


def heuristic_weights(counts, densities, exponent):
    """With a mistake."""
    _check_strategies("counts", counts, densities)
    if not exponent >= 1:
        raise ValueError(f"exponent must be >= 1, got {exponent}")
    drawn = np.asarray(counts, np.float64)[:, None] * densities
    largest = drawn.max(axis=0)
    with np.errstate(all="ignore"):
        power = (drawn / largest) ** float(exponent)
        return (power / power.sum(axis=0)).astype(densities.dtype)
