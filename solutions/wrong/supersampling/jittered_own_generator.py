"""Makes a generator of its own and leaves the one that is given aside."""

import numpy as np

FUNCTION = "jittered"
CAUGHT_BY = "from_rng"
MISTAKE = "jittered-own-generator"
SAYS = "Two generators with the same seed give you different points: the numbers come from somewhere other than the generator that is handed in."


def jittered(k, n, rng):
    """One uniform point in each cell."""
    _check_counts(k, n)
    number = np.arange(k * k)
    corner = np.stack((number % k, number // k))[:, None, :]
    rng = np.random.default_rng()
    return ((corner + rng.random((2, n, k * k))) / k).astype(np.float32)
