"""Returns float64, as rng.random does by itself."""

import numpy as np

FUNCTION = "jittered"
CAUGHT_BY = "contract"
MISTAKE = "jittered-float64"
SAYS = (
    "Your result is float64; the course's pictures are float32, and so should the result be here."
)


def jittered(k, n, rng):
    """One uniform point in each cell."""
    _check_counts(k, n)
    number = np.arange(k * k)
    corner = np.stack((number % k, number // k))[:, None, :]
    return (corner + rng.random((2, n, k * k))) / k
