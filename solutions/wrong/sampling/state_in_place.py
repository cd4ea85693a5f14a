"""The caller's states are stepped in place."""

import numpy as np

FUNCTION = "xorshift32"
CAUGHT_BY = "untouched"
MISTAKE = "writes-to-arguments"


def xorshift32(state):
    """The next number of each stream."""
    _check_state(state)
    state ^= state << 13
    state ^= state >> 17
    state ^= state << 5
    return state, (state >> 8).astype(np.float32) * np.float32(2**-24)


def _check_state(state):
    if np.ndim(state) != 1:
        raise ValueError(f"state must have shape (N,), got {np.shape(state)}")
    if getattr(state, "dtype", None) != np.uint32:
        raise ValueError("state must be uint32")
