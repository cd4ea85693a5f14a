"""Normal numbers about the centre, clipped to the pixel."""

import numpy as np

FUNCTION = "random"
CAUGHT_BY = "uniform"
MISTAKE = "normal"
SAYS = "Your points gather in the pixel's middle; they should be uniform in it."


def random(k, n, rng):
    """Independent uniform points."""
    _check_counts(k, n)
    points = rng.normal(0.5, 1 / 6, (2, n, k * k))
    return np.clip(points, 0, 1).astype(np.float32)
