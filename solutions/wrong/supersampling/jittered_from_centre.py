"""Jitter from a cell's centre to one side, so that points leave their cells."""

import numpy as np

FUNCTION = "jittered"
CAUGHT_BY = "cells"
MISTAKE = "jitter-from-centre"
SAYS = "Your jitter goes from a cell's centre to one side, so half of the points leave their cells."


def jittered(k, n, rng):
    """One uniform point in each cell."""
    _check_counts(k, n)
    jitter = rng.random((2, n, k * k), dtype=np.float32)
    return regular(k, n) + jitter / np.float32(k)
