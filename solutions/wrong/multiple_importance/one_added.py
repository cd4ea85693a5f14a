"""A small number in the density."""

import numpy as np

FUNCTION = "one_sample"
CAUGHT_BY = "undrawn"
MISTAKE = "something-added-to-the-density"
SAYS = "You add a small number to the density, and what nobody draws counts much."


def one_sample(odds, f, densities):
    """With a mistake."""
    _check_strategies("odds", odds, densities)
    _check("f", f, 3, np.shape(densities)[1])
    drawn = np.asarray(odds, np.float64) @ densities + 1e-4
    return (f / drawn).astype(np.result_type(f, densities))
