"""Over a hundred degrees, where the table of the book ends, it is the normal distribution's."""

from statistics import NormalDist

import numpy as np

FUNCTION = "critical_value"
CAUGHT_BY = "hundreds"
MISTAKE = None

_right = critical_value


def critical_value(degrees, level):
    """With a mistake."""
    found = _right(degrees, level)
    return np.where(degrees > 100, NormalDist().inv_cdf(1 - level / 2), found).astype(found.dtype)
