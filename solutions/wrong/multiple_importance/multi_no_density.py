"""Without densities."""

import numpy as np

FUNCTION = "multi_sample"
CAUGHT_BY = "values"
MISTAKE = "densities-left-out"
SAYS = "You leave the densities out."


def multi_sample(counts, strategy, f, densities, weights):
    """With a mistake."""
    _check("counts", counts, "S")
    _check("f", f, 3, "N")
    for name, each in (("strategy", strategy), ("densities", densities), ("weights", weights)):
        _check(name, each, np.shape(f)[1])
    drawn = np.asarray(counts)[strategy] * np.asarray(densities, np.float64)
    share = np.where(drawn > 0, weights, 0) / np.asarray(counts)[strategy]
    return (f @ share).astype(np.result_type(f, densities, weights))
