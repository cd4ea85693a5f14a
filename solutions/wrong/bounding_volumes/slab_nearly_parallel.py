"""Takes a line that is nearly parallel to faces for one that is."""

import numpy as np

FUNCTION = "slab_test"
CAUGHT_BY = "parallel"
MISTAKE = "nearly-parallel"
SAYS = "You take a small component for none: far away such a line is elsewhere."

_right = slab_test


def slab_test(origins, directions, lo, hi):
    """Lines and boxes."""
    small = np.abs(directions) < 1e-3
    return _right(origins, np.where(small, directions.dtype.type(0), directions), lo, hi)
