"""Counts from the largest number down."""

import numpy as np

FUNCTION = "radical_inverse"
CAUGHT_BY = "exact"
MISTAKE = "counted-down"
SAYS = "You give 1 less the radical inverse: that of 0 is 0."


def radical_inverse(base, i):
    """With a mistake."""
    _check_inverse(base, i)
    return np.float32(1) - _mirrored(base, i)


def _check_inverse(base, i):
    if not base >= 2 or base != int(base):
        raise ValueError(f"base must be an integer >= 2, got {base}")
    _check_indices("i", i)
