"""Leaves before it enters."""

import numpy as np

FUNCTION = "slab_test"
CAUGHT_BY = "through"
MISTAKE = "exchanged"
SAYS = "You hand back t_far before t_near."

_right = slab_test


def slab_test(origins, directions, lo, hi):
    """Lines and boxes."""
    near, far = _right(origins, directions, lo, hi)
    return far, near
