"""The largest only."""

import numpy as np

FUNCTION = "one_sample"
CAUGHT_BY = "values"
MISTAKE = "largest-density-only"
SAYS = "You divide by the largest density alone."


def one_sample(odds, f, densities):
    """With a mistake."""
    _check_strategies("odds", odds, densities)
    _check("f", f, 3, np.shape(densities)[1])
    drawn = (np.asarray(odds, np.float64)[:, None] * densities).max(axis=0)
    found = np.where(drawn > 0, f, 0) / np.where(drawn > 0, drawn, 1)
    return found.astype(np.result_type(f, densities))
