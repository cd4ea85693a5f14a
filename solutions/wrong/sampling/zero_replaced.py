"""Starts anew from 1 where a state is 0."""

import numpy as np

FUNCTION = "xorshift32"
CAUGHT_BY = "ends"
MISTAKE = "zero-replaced"
SAYS = "A state of 0 is exchanged for another; by definition 0 stays 0."

_right = xorshift32


def xorshift32(state):
    """The next number of each stream."""
    return _right(np.where(state == 0, np.uint32(1), state)) if np.shape(state) else _right(state)
