"""Division by a density of 0."""

import numpy as np

FUNCTION = "multi_sample"
CAUGHT_BY = "zero_density"
MISTAKE = "divides-by-no-density"
SAYS = "A sample of density 0 counts 0: you divide by it."


def multi_sample(counts, strategy, f, densities, weights):
    """With a mistake."""
    _check("counts", counts, "S")
    _check("f", f, 3, "N")
    for name, each in (("strategy", strategy), ("densities", densities), ("weights", weights)):
        _check(name, each, np.shape(f)[1])
    drawn = np.asarray(counts)[strategy] * np.asarray(densities, np.float64)
    with np.errstate(all="ignore"):
        return (f @ (weights / drawn)).astype(np.result_type(f, densities, weights))
