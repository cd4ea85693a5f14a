"""The lower 24 bits."""

import numpy as np

FUNCTION = "xorshift32"
CAUGHT_BY = "random"
MISTAKE = "lower-bits"
SAYS = (
    "Your random number is made of the lower bits of the state; the upper ones say how large it is."
)

_right = xorshift32


def xorshift32(state):
    """The next number of each stream."""
    new, random = _right(state)
    return new, (new & np.uint32(0xFFFFFF)).astype(np.float32) * np.float32(2**-24)
