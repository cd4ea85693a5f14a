"""The density is kept above 1e-9."""

import numpy as np

FUNCTION = "one_sample"
CAUGHT_BY = "small"
MISTAKE = None


def one_sample(odds, f, densities):
    """With a mistake."""
    _check_strategies("odds", odds, densities)
    _check("f", f, 3, np.shape(densities)[1])
    drawn = np.asarray(odds, np.float64) @ densities
    found = np.where(drawn > 0, f, 0) / np.maximum(drawn, 1e-9)
    return found.astype(np.result_type(f, densities))
