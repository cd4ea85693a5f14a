"""The numbers are used up in place."""

import numpy as np

FUNCTION = "radical_inverse"
CAUGHT_BY = "untouched"
MISTAKE = "writes-to-arguments"


def radical_inverse(base, i):
    """With a mistake."""
    _check_inverse(base, i)
    value, weight = np.zeros(len(i)), 1 / base
    while i.any():
        value += i % base * weight
        i //= i.dtype.type(base)
        weight /= base
    return value.astype(np.float32).clip(0, 1)


def _check_inverse(base, i):
    if not base >= 2 or base != int(base):
        raise ValueError(f"base must be an integer >= 2, got {base}")
    _check_indices("i", i)
