"""Densities below 1e-9 count 0."""

import numpy as np

FUNCTION = "multi_sample"
CAUGHT_BY = "small"
MISTAKE = None


def multi_sample(counts, strategy, f, densities, weights):
    """With a mistake."""
    _check("counts", counts, "S")
    _check("f", f, 3, "N")
    for name, each in (("strategy", strategy), ("densities", densities), ("weights", weights)):
        _check(name, each, np.shape(f)[1])
    drawn = np.asarray(counts)[strategy] * np.asarray(densities, np.float64)
    share = np.where(drawn > 1e-9, weights, 0) / np.where(drawn > 1e-9, drawn, 1)
    return (f @ share).astype(np.result_type(f, densities, weights))
