"""Jitter of half a cell, about its centre."""

import numpy as np

FUNCTION = "jittered"
CAUGHT_BY = "uniform"
MISTAKE = "jitter-too-narrow"
SAYS = "Your jitter is narrower than a cell, so its borders get no points: it should be as wide as the cell."


def jittered(k, n, rng):
    """One uniform point in each cell."""
    _check_counts(k, n)
    number = np.arange(k * k)
    corner = np.stack((number % k, number // k))[:, None, :]
    jitter = 0.25 + 0.5 * rng.random((2, n, k * k))
    return ((corner + jitter) / k).astype(np.float32)
