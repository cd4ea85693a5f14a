"""64 bits, and what should have fallen off the left stays."""

import numpy as np

FUNCTION = "xorshift32"
CAUGHT_BY = "contract"
MISTAKE = "more-than-32-bits"
SAYS = "Your state is wider than 32 bits, so bits that should fall off on the left stay."


def xorshift32(state):
    """The next number of each stream."""
    _check_state(state)
    state = state.astype(np.uint64)
    state = state ^ (state << 13)
    state = state ^ (state >> 17)
    state = state ^ (state << 5)
    return state, (state / 2**32 % 1).astype(np.float32)


def _check_state(state):
    if np.ndim(state) != 1:
        raise ValueError(f"state must have shape (N,), got {np.shape(state)}")
    if getattr(state, "dtype", None) != np.uint32:
        raise ValueError("state must be uint32")
