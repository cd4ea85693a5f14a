"""Takes the middle of a box with lamps around it for the place of a lamp without size."""

import numpy as np

FUNCTION = "importance"
CAUGHT_BY = "inside"
MISTAKE = None

_right = importance


def importance(lo, hi, axis, angle, power, p, n):
    """Nothing from where there is no direction."""
    found = _right(lo, hi, axis, angle, power, p, n)
    return np.where((lo + (hi - lo) / 2 == p).all(axis=0), 0, found).astype(found.dtype)
