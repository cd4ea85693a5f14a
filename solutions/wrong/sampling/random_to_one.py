"""Rounded to the nearest number of single precision, which for the largest states is 1."""

import numpy as np

FUNCTION = "xorshift32"
CAUGHT_BY = "below-one"
MISTAKE = None

_right = xorshift32


def xorshift32(state):
    """The next number of each stream."""
    new, random = _right(state)
    return new, (new / 2.0**32).astype(np.float32)
