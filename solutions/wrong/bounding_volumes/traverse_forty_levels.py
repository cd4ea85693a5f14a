"""Hierarchies of more than forty levels are refused."""

import numpy as np

FUNCTION = "traverse"
CAUGHT_BY = "deep"
MISTAKE = None

_right = traverse


def traverse(hierarchy, p0, p1, p2, origins, directions):
    """With a mistake."""
    first, count = hierarchy[2:4]
    level, levels = np.zeros(1, int), 0
    while level.size:
        left = first[level[count[level] == 0]]
        level, levels = np.concatenate((left, left + 1)), levels + 1
    if levels > 40:
        raise RecursionError("too deep")
    return _right(hierarchy, p0, p1, p2, origins, directions)
