"""Divided by 2^31."""

import numpy as np

FUNCTION = "xorshift32"
CAUGHT_BY = "random"
MISTAKE = "divided-by-2^31"
SAYS = "Your random numbers reach 2: an unsigned number of 32 bits has 2^32 values."


def xorshift32(state):
    """The next number of each stream."""
    _check_state(state)
    new = state ^ (state << 13)
    new = new ^ (new >> 17)
    new = new ^ (new << 5)
    return new, new.astype(np.float32) * np.float32(2**-31)


def _check_state(state):
    if np.ndim(state) != 1:
        raise ValueError(f"state must have shape (N,), got {np.shape(state)}")
    if getattr(state, "dtype", None) != np.uint32:
        raise ValueError("state must be uint32")
