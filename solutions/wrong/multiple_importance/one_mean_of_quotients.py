"""The mean of the quotients."""

import numpy as np

FUNCTION = "one_sample"
CAUGHT_BY = "values"
MISTAKE = "mean-of-the-quotients"
SAYS = (
    "You average f / p over the strategies: the densities are averaged, and f is divided by that."
)


def one_sample(odds, f, densities):
    """With a mistake."""
    _check_strategies("odds", odds, densities)
    _check("f", f, 3, np.shape(densities)[1])
    found = np.zeros(np.shape(f))
    for chance, row in zip(odds, densities, strict=True):
        found += chance * np.where(row > 0, f, 0) / np.where(row > 0, row, 1)
    return found.astype(np.result_type(f, densities))
