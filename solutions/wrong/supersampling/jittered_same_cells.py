"""One jitter for all cells of a pixel: the grid is shifted as a whole."""

import numpy as np

FUNCTION = "jittered"
CAUGHT_BY = "samples"
MISTAKE = "jittered-same-cells"
SAYS = "All cells of a pixel get the same jitter, so your points are a regular grid that is shifted as a whole."


def jittered(k, n, rng):
    """One uniform point in each cell."""
    _check_counts(k, n)
    number = np.arange(k * k)
    corner = np.stack([number % k, number // k])[:, None, :]
    return ((corner + rng.random((2, n, 1))) / k).astype(np.float32)
