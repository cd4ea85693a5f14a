"""Of the new state 23 bits are kept, though the result holds 24."""

import numpy as np

FUNCTION = "xorshift32"
CAUGHT_BY = "random"
MISTAKE = None


def xorshift32(state):
    """With a mistake."""
    if np.ndim(state) != 1:
        raise ValueError(f"state must have shape (N,), got {np.shape(state)}")
    if getattr(state, "dtype", None) != np.uint32:
        raise ValueError(f"state must be uint32, got {getattr(state, 'dtype', type(state))}")
    state = state ^ (state << np.uint32(13))
    state ^= state >> np.uint32(17)
    state ^= state << np.uint32(5)
    return state, (state >> np.uint32(9)).astype(np.float32) / np.float32(2**23)
