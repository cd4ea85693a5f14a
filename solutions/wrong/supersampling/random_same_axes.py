"""One random number for both x and y."""

import numpy as np

FUNCTION = "random"
CAUGHT_BY = "uniform"
MISTAKE = "random-same-axes"
SAYS = "You use the same random number for x and for y, so the points lie on a diagonal."


def random(k, n, rng):
    """Independent uniform points."""
    _check_counts(k, n)
    x = rng.random((n, k * k), dtype=np.float32)
    return np.stack([x, x])
