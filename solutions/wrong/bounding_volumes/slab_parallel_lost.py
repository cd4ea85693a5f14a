"""Every line with a component of zero misses."""

import numpy as np

FUNCTION = "slab_test"
CAUGHT_BY = "parallel"
MISTAKE = "parallel-lost"
SAYS = "You lose every line with a component of zero."

_right = slab_test


def slab_test(origins, directions, lo, hi):
    """Lines and boxes."""
    near, far = _right(origins, directions, lo, hi)
    lost = (directions == 0).any(axis=0)
    return np.where(lost, near.dtype.type(np.inf), near), np.where(
        lost, -far.dtype.type(np.inf), far
    )
