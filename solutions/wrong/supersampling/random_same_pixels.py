"""The same random points in every pixel."""

import numpy as np

FUNCTION = "random"
CAUGHT_BY = "pixels"
MISTAKE = "random-same-pixels"


def random(k, n, rng):
    """Independent uniform points."""
    _check_counts(k, n)
    points = rng.random((2, 1, k * k), dtype=np.float32)
    return np.repeat(points, n, axis=1)
