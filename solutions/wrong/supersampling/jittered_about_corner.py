"""Jitter to both sides of a cell's corner."""

import numpy as np

FUNCTION = "jittered"
CAUGHT_BY = "cells"
MISTAKE = "jitter-about-corner"
SAYS = "Your jitter goes to both sides of a cell's corner, so most points leave their cells."


def jittered(k, n, rng):
    """One uniform point in each cell."""
    _check_counts(k, n)
    number = np.arange(k * k)
    corner = np.stack([number % k, number // k])[:, None, :] / k
    jitter = (rng.random((2, n, k * k)) - 0.5) / k
    return (corner + jitter).astype(np.float32)
