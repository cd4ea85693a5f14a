"""Draws from NumPy's global random state."""

import numpy as np

FUNCTION = "random"
CAUGHT_BY = "untouched"
MISTAKE = "random-own-generator"
SAYS = "Two generators with the same seed give you different points: the numbers come from somewhere other than the generator that is handed in."


def random(k, n, rng):  # noqa: ARG001
    """Independent uniform points."""
    _check_counts(k, n)
    return np.random.rand(2, n, k * k).astype(np.float32)  # noqa: NPY002
