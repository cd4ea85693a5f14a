"""Makes a generator of its own and leaves the one that is given aside."""

import numpy as np

FUNCTION = "random"
CAUGHT_BY = "from_rng"
MISTAKE = "random-own-generator"


def random(k, n, rng):
    """Independent uniform points."""
    _check_counts(k, n)
    rng = np.random.default_rng()
    return rng.random((2, n, k * k), dtype=np.float32)
