"""One corner for all rays and another for each are refused."""

import numpy as np

FUNCTION = "slab_test"
CAUGHT_BY = "layouts"
MISTAKE = None

_right = slab_test


def slab_test(origins, directions, lo, hi):
    """With a mistake."""
    if np.ndim(lo) != np.ndim(hi):
        raise TypeError("lo and hi must be alike")
    return _right(origins, directions, lo, hi)
