"""Goes on from where its last call ended, whatever comes."""

import numpy as np

FUNCTION = "xorshift32"
CAUGHT_BY = "known"
MISTAKE = None

_right = xorshift32
_KEPT = {}


def xorshift32(state):
    """The next number of each stream."""
    kept = _KEPT.get(len(state)) if np.ndim(state) == 1 else None
    new, random = _right(state if kept is None else kept)
    _KEPT[len(state)] = new
    return new, random
