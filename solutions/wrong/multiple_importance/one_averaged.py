"""Over the number of samples."""

import numpy as np

FUNCTION = "one_sample"
CAUGHT_BY = "values"
MISTAKE = "averaged-over-samples"
SAYS = "You divide by the number of samples: each of the N estimates stands for itself."


def one_sample(odds, f, densities):
    """With a mistake."""
    _check_strategies("odds", odds, densities)
    _check("f", f, 3, np.shape(densities)[1])
    drawn = np.asarray(odds, np.float64) @ densities
    drawn = drawn * max(np.shape(f)[1], 1)
    found = np.where(drawn > 0, f, 0) / np.where(drawn > 0, drawn, 1)
    return found.astype(np.result_type(f, densities))
