"""A small number added to the divisor."""

import numpy as np

FUNCTION = "power_heuristic"
CAUGHT_BY = "extremes"
MISTAKE = "divisor-enlarged"
SAYS = "What you add to the divisor against dividing by 0 is not small beside the squares of small densities."


def power_heuristic(a, b):
    """With a mistake."""
    _check_numbers("a", a)
    _check_numbers("b", b, np.shape(a)[0])
    _check_not_negative("a", a)
    _check_not_negative("b", b)
    return a * a / (a * a + b * b + a.dtype.type(1e-8))
