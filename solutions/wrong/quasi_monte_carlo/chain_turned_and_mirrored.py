"""Permutations are turns and mirror images of the order only."""

import numpy as np

FUNCTION = "chain"
CAUGHT_BY = "sizes"
MISTAKE = None


def chain(patterns, ids, rng):
    """With a mistake."""
    for k, pattern in enumerate(patterns):
        shape, s = np.shape(pattern), np.shape(patterns[0])[-1:]
        if len(shape) != 2 or shape[1:] != s:
            raise ValueError(f"patterns[{k}] must have shape (d, s), got {shape}")
    _check_indices("ids", ids)
    if len(patterns) and not (ids < np.shape(patterns[0])[1]).all():
        raise ValueError(f"ids must be < {np.shape(patterns[0])[1]}, got {ids.max()}")
    found = []
    for pattern in patterns:
        s = pattern.shape[1]
        turned = (ids.astype(np.int64) * rng.choice((1, -1)) + rng.integers(s)) % max(s, 1)
        found.append(pattern[:, turned])
    return tuple(found)
