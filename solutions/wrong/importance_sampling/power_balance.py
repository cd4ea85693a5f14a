"""The balance heuristic."""

import numpy as np

FUNCTION = "power_heuristic"
CAUGHT_BY = "values"
MISTAKE = "balance-heuristic"
SAYS = "You weigh by the densities themselves, not by their squares: that is the balance heuristic."


def power_heuristic(a, b):
    """With a mistake."""
    _check_numbers("a", a)
    _check_numbers("b", b, np.shape(a)[0])
    _check_not_negative("a", a)
    _check_not_negative("b", b)
    with np.errstate(all="ignore"):
        return np.where(a > 0, a / (a + b), 0).astype(np.result_type(a, b))
