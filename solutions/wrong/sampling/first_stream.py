"""All streams go the way of the first."""

import numpy as np

FUNCTION = "xorshift32"
CAUGHT_BY = "streams"
MISTAKE = "one-stream"
SAYS = "All your streams are one: each state has to take its own step."

_right = xorshift32


def xorshift32(state):
    """The next number of each stream."""
    new, random = _right(state)
    return np.repeat(new[:1], len(new)), np.repeat(random[:1], len(new))
