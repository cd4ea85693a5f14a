"""The other one's weight."""

import numpy as np

FUNCTION = "power_heuristic"
CAUGHT_BY = "values"
MISTAKE = "weights-swapped"
SAYS = "You return the weight of the sample drawn with b."


def power_heuristic(a, b):
    """With a mistake."""
    _check_numbers("a", a)
    _check_numbers("b", b, np.shape(a)[0])
    _check_not_negative("a", a)
    _check_not_negative("b", b)
    with np.errstate(all="ignore"):
        ratio = a / b
        return np.where(b > 0, 1 / (1 + ratio * ratio), 0).astype(ratio.dtype)
