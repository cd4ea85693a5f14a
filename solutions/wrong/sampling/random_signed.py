"""Taken for a signed number."""

import numpy as np

FUNCTION = "xorshift32"
CAUGHT_BY = "random"
MISTAKE = "signed"
SAYS = "Half of your random numbers are negative: the state is an unsigned number."

_right = xorshift32


def xorshift32(state):
    """The next number of each stream."""
    new, random = _right(state)
    return new, (new.view(np.int32) / 2.0**32).astype(np.float32)
