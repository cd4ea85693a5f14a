"""A shuffle that swaps each sample with any other, those that have their place included."""

import numpy as np

FUNCTION = "chain"
CAUGHT_BY = "sizes"
MISTAKE = None

_right = chain


def chain(patterns, ids, rng):
    """With a mistake."""
    _right(patterns, ids, np.random.default_rng(0))
    return tuple(pattern[:, _shuffled(pattern.shape[1], rng)[ids]] for pattern in patterns)


def _shuffled(s, rng):
    order = np.arange(s)
    for one, other in enumerate(rng.integers(0, s, s)):
        order[[one, other]] = order[[other, one]]
    return order
