"""Sixteen digits and no more."""

import numpy as np

FUNCTION = "radical_inverse"
CAUGHT_BY = "large"
MISTAKE = None


def radical_inverse(base, i):
    """With a mistake."""
    _check_inverse(base, i)
    rest, value, weight = i.astype(np.int64), np.zeros(len(i)), 1 / base
    for _ in range(20):
        value += rest % base * weight
        rest, weight = rest // base, weight / base
    return value.astype(np.float32)


def _check_inverse(base, i):
    if not base >= 2 or base != int(base):
        raise ValueError(f"base must be an integer >= 2, got {base}")
    _check_indices("i", i)
