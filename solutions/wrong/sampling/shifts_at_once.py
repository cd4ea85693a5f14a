"""All shifts in one expression."""

import numpy as np

FUNCTION = "xorshift32"
CAUGHT_BY = "known"
MISTAKE = "all-from-the-first"
SAYS = "All three shifts start from the state as it came; each has to start from what the one before left."


def xorshift32(state):
    """The next number of each stream."""
    _check_state(state)
    state = state ^ (state << 13) ^ (state >> 17) ^ (state << 5)
    return state, (state >> 8).astype(np.float32) * np.float32(2**-24)


def _check_state(state):
    if np.ndim(state) != 1:
        raise ValueError(f"state must have shape (N,), got {np.shape(state)}")
    if getattr(state, "dtype", None) != np.uint32:
        raise ValueError("state must be uint32")
