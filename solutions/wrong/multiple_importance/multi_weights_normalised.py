"""Over the sum of the weights."""

import numpy as np

FUNCTION = "multi_sample"
CAUGHT_BY = "values"
MISTAKE = "weights-normalised-again"
SAYS = "You divide by the sum of the weights: they add up to 1 for each sample already, over the strategies."


def multi_sample(counts, strategy, f, densities, weights):
    """With a mistake."""
    _check("counts", counts, "S")
    _check("f", f, 3, "N")
    for name, each in (("strategy", strategy), ("densities", densities), ("weights", weights)):
        _check(name, each, np.shape(f)[1])
    drawn = np.asarray(counts)[strategy] * np.asarray(densities, np.float64)
    share = np.where(drawn > 0, weights, 0) / np.where(drawn > 0, drawn, 1)
    share = share / max(np.sum(weights), 1e-30)
    return (f @ share).astype(np.result_type(f, densities, weights))
