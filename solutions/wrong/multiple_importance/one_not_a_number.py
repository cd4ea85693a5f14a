"""Division by a density of 0."""

import numpy as np

FUNCTION = "one_sample"
CAUGHT_BY = "undrawn"
MISTAKE = "divides-by-nobody"
SAYS = "What no strategy draws counts 0: you divide by 0."


def one_sample(odds, f, densities):
    """With a mistake."""
    _check_strategies(odds, densities)
    _check_batch("f", f, 2, np.shape(densities)[1])
    drawn = np.asarray(odds, np.float64) @ densities
    with np.errstate(all="ignore"):
        return (f / drawn).astype(np.result_type(f, densities))
