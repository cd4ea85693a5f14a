"""One random number for both x and y."""

import numpy as np

FUNCTION = "random"
CAUGHT_BY = "uniform"
MISTAKE = "random-same-axes"


def random(k, n, rng):
    """Independent uniform points."""
    _check_counts(k, n)
    x = rng.random((n, k * k), dtype=np.float32)
    return np.stack([x, x])
