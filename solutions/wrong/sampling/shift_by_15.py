"""By 13, 17 and 15."""

import numpy as np

FUNCTION = "xorshift32"
CAUGHT_BY = "known"
MISTAKE = "other-shifts"
SAYS = "The shifts are others than the three of this generator."

_right = xorshift32


def xorshift32(state):
    """The next number of each stream."""
    _right(state)
    state = state ^ (state << np.uint32(13))
    state ^= state >> np.uint32(17)
    state ^= state << np.uint32(15)
    return state, (state >> np.uint32(8)).astype(np.float32) * np.float32(2**-24)
