"""The plain mean of the densities."""

import numpy as np

FUNCTION = "one_sample"
CAUGHT_BY = "values"
MISTAKE = "plain-mean-of-densities"
SAYS = "You take the plain mean of the densities: strategies are chosen by their odds."


def one_sample(odds, f, densities):
    """With a mistake."""
    _check_strategies("odds", odds, densities)
    _check("f", f, 3, np.shape(densities)[1])
    drawn = np.mean(densities, axis=0, dtype=np.float64)
    found = np.where(drawn > 0, f, 0) / np.where(drawn > 0, drawn, 1)
    return found.astype(np.result_type(f, densities))
