"""Returns float32, whatever the patterns are."""

import numpy as np

FUNCTION = "chain"
CAUGHT_BY = "contract"
MISTAKE = "other-dtype"


def chain(patterns, ids, rng):
    """With a mistake."""
    _check_chain(patterns, ids)
    orders = [rng.permutation(pattern.shape[1]) for pattern in patterns]
    pairs = zip(patterns, orders, strict=True)
    return tuple(pattern[:, order[ids]].astype(np.float32) for pattern, order in pairs)


def _check_chain(patterns, ids):
    for k, pattern in enumerate(patterns):
        if np.ndim(pattern) != 2 or np.shape(pattern)[1:] != np.shape(patterns[0])[1:]:
            raise ValueError(f"patterns[{k}] has shape {np.shape(pattern)}")
    _check_indices("ids", ids)
    if len(patterns) and not (ids < np.shape(patterns[0])[1]).all():
        raise ValueError("ids must be < s")
