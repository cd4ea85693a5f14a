"""Cells column by column: y grows first."""

import numpy as np

FUNCTION = "jittered"
CAUGHT_BY = "order"
MISTAKE = "jittered-columns"
SAYS = "Your cells come column by column; x should grow first, then y."


def jittered(k, n, rng):
    """One uniform point in each cell."""
    _check_counts(k, n)
    points = np.empty((2, n, k * k), np.float32)
    for i in range(k):
        for j in range(k):
            points[0, :, i * k + j] = (i + rng.random(n)) / k
            points[1, :, i * k + j] = (j + rng.random(n)) / k
    return points
