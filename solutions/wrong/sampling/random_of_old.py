"""The random number of the state before."""

import numpy as np

FUNCTION = "xorshift32"
CAUGHT_BY = "random"
MISTAKE = "random-of-the-old-state"
SAYS = "The random number is made of the state before the step; it should be made of the new one."


def xorshift32(state):
    """The next number of each stream."""
    _check_state(state)
    new = state ^ (state << 13)
    new = new ^ (new >> 17)
    new = new ^ (new << 5)
    return new, (state >> 8).astype(np.float32) * np.float32(2**-24)


def _check_state(state):
    if np.ndim(state) != 1:
        raise ValueError(f"state must have shape (N,), got {np.shape(state)}")
    if getattr(state, "dtype", None) != np.uint32:
        raise ValueError("state must be uint32")
