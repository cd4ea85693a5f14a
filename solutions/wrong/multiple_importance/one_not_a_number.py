"""Division by a density of 0."""

import numpy as np

FUNCTION = "one_sample"
CAUGHT_BY = "undrawn"
MISTAKE = "divides-by-nobody"
SAYS = "What no strategy draws counts 0: you divide by 0."


def one_sample(odds, f, densities):
    """With a mistake."""
    _check_strategies("odds", odds, densities)
    _check("f", f, 3, np.shape(densities)[1])
    drawn = np.asarray(odds, np.float64) @ densities
    with np.errstate(all="ignore"):
        return (f / drawn).astype(np.result_type(f, densities))
