"""The power heuristic's sum."""

import numpy as np

FUNCTION = "one_sample"
CAUGHT_BY = "values"
MISTAKE = "squares-of-densities"
SAYS = "You square: with balance weights the densities stand as they are."


def one_sample(odds, f, densities):
    """With a mistake."""
    _check_strategies("odds", odds, densities)
    _check("f", f, 3, np.shape(densities)[1])
    drawn = np.asarray(odds, np.float64) ** 2 @ np.asarray(densities, np.float64) ** 2
    found = np.where(drawn > 0, f, 0) / np.where(drawn > 0, drawn, 1)
    return found.astype(np.result_type(f, densities))
