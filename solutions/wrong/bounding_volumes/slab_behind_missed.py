"""Boxes behind the origin are missed."""

import numpy as np

FUNCTION = "slab_test"
CAUGHT_BY = "through"
MISTAKE = "behind-missed"
SAYS = "You miss boxes behind the origin; where a line enters and leaves them, t is negative."

_right = slab_test


def slab_test(origins, directions, lo, hi):
    """Lines and boxes."""
    near, far = _right(origins, directions, lo, hi)
    return np.where(far < 0, near.dtype.type(np.inf), near), far
