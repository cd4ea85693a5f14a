"""The same jitter along x and along y."""

import numpy as np

FUNCTION = "jittered"
CAUGHT_BY = "uniform"
MISTAKE = "jittered-same-axes"
SAYS = "You use the same random number for x and for y, so the points lie on a diagonal."


def jittered(k, n, rng):
    """One uniform point in each cell."""
    _check_counts(k, n)
    number = np.arange(k * k)
    jitter = rng.random((n, k * k), dtype=np.float32)
    points = np.empty((2, n, k * k), np.float32)
    points[0] = (number % k + jitter) / k
    points[1] = (number // k + jitter) / k
    return points
