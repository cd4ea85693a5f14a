"""Makes the same pattern in every call."""

import numpy as np

FUNCTION = "jittered"
CAUGHT_BY = "from_rng"
MISTAKE = None


def jittered(k, n, rng):  # noqa: ARG001
    """One uniform point in each cell."""
    _check_counts(k, n)
    number = np.arange(k * k)
    corner = np.stack((number % k, number // k))[:, None, :]
    rng = np.random.default_rng(7)
    return ((corner + rng.random((2, n, k * k))) / k).astype(np.float32)
