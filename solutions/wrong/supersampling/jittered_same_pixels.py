"""The same jitter in every pixel."""

import numpy as np

FUNCTION = "jittered"
CAUGHT_BY = "pixels"
MISTAKE = "jittered-same-pixels"
SAYS = "Every pixel gets the same points, which shows as a repeating pattern; each needs random numbers of its own."


def jittered(k, n, rng):
    """One uniform point in each cell."""
    _check_counts(k, n)
    number = np.arange(k * k)
    corner = np.stack((number % k, number // k))[:, None, :]
    points = (corner + rng.random((2, 1, k * k))) / k
    return np.repeat(points, n, axis=1).astype(np.float32)
