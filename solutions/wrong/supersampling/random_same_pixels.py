"""The same random points in every pixel."""

import numpy as np

FUNCTION = "random"
CAUGHT_BY = "pixels"
MISTAKE = "random-same-pixels"
SAYS = "Every pixel gets the same points, which shows as a repeating pattern; each needs random numbers of its own."


def random(k, n, rng):
    """Independent uniform points."""
    _check_counts(k, n)
    points = rng.random((2, 1, k * k), dtype=np.float32)
    return np.repeat(points, n, axis=1)
