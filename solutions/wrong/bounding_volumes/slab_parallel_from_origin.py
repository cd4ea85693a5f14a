"""A line along faces enters the box at its origin at the earliest."""

import numpy as np

FUNCTION = "slab_test"
CAUGHT_BY = "parallel"
MISTAKE = "parallel-from-origin"
SAYS = "Between two faces is so for all t, behind the origin, too."

_right = slab_test


def slab_test(origins, directions, lo, hi):
    """Lines and boxes."""
    near, far = _right(origins, directions, lo, hi)
    along = (directions == 0).any(axis=0) & (near <= far)
    return np.where(along, np.maximum(near, 0), near), far
