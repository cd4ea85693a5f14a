"""A half where no density could have drawn the sample."""

import numpy as np

FUNCTION = "power_heuristic"
CAUGHT_BY = "limits"
MISTAKE = "half-for-none"
SAYS = "Where both densities are 0 your weight is not 0; such a sample must not count."


def power_heuristic(a, b):
    """With a mistake."""
    _check_numbers("a", a)
    _check_numbers("b", b, np.shape(a)[0])
    _check_not_negative("a", a)
    _check_not_negative("b", b)
    total = a * a + b * b
    safe = np.where(total > 0, total, 1)
    return np.where(total > 0, a * a / safe, 0.5).astype(np.result_type(a, b))
