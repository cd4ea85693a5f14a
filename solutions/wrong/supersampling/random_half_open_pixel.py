"""Points from -1/2 to 1/2, about the pixel's centre."""

import numpy as np

FUNCTION = "random"
CAUGHT_BY = "inside"
MISTAKE = "about-zero"
SAYS = "Your points go from -1/2 to 1/2; places in a pixel go from 0 to 1."


def random(k, n, rng):
    """Independent uniform points."""
    _check_counts(k, n)
    return rng.random((2, n, k * k), np.float32) - np.float32(0.5)
