"""0 / 0 where both densities are 0."""

import numpy as np

FUNCTION = "power_heuristic"
CAUGHT_BY = "limits"
MISTAKE = "weights-zero-by-zero"
SAYS = "0 is divided by 0 where both densities are 0."


def power_heuristic(a, b):
    """With a mistake."""
    _check_numbers("a", a)
    _check_numbers("b", b, np.shape(a)[0])
    _check_not_negative("a", a)
    _check_not_negative("b", b)
    with np.errstate(all="ignore"):
        ratio = b / a
        return 1 / (1 + ratio * ratio)
