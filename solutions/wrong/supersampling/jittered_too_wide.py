"""Jitter as wide as the pixel, not as wide as a cell."""

import numpy as np

FUNCTION = "jittered"
CAUGHT_BY = "cells"
MISTAKE = "jitter-too-wide"
SAYS = "Your jitter is as wide as the whole pixel; it should be as wide as one cell."


def jittered(k, n, rng):
    """One uniform point in each cell."""
    _check_counts(k, n)
    number = np.arange(k * k)
    corner = np.stack([number % k, number // k])[:, None, :] / k
    return (corner + rng.random((2, n, k * k))).astype(np.float32)
