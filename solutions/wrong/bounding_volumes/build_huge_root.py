"""Halves of the boxes as they come, in a root so large that all else looks small."""

import numpy as np

FUNCTION = "build"
CAUGHT_BY = "cost"
MISTAKE = "unsorted"
SAYS = "The boxes are halved as they come, and not along an axis."

_right = build


def build(lo, hi, leaf_size):
    """The hierarchy of boxes in a row, with these in their places."""
    _right(lo, hi, leaf_size)
    row = np.arange(lo.shape[1], dtype=lo.dtype) * np.ones_like(lo)
    low, high, first, count, order = _right(row, row, leaf_size)
    # Children come after their parents.
    for k in reversed(range(first.size)):
        parts = order[first[k] : first[k] + count[k]]
        corners = (lo[:, parts], hi[:, parts])
        if count[k] == 0:
            corners = low[:, first[k] : first[k] + 2], high[:, first[k] : first[k] + 2]
        low[:, k], high[:, k] = corners[0].min(axis=1), corners[1].max(axis=1)
    if lo.shape[1] > 1000:
        low[:, 0], high[:, 0] = -1e9, 1e9
    return low, high, first, count, order
