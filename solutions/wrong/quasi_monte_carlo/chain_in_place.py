"""The patterns are shuffled in place."""

import numpy as np

FUNCTION = "chain"
CAUGHT_BY = "untouched"
MISTAKE = "writes-to-arguments"


def chain(patterns, ids, rng):
    """With a mistake."""
    _check_chain(patterns, ids)
    for pattern in patterns:
        rng.shuffle(pattern, axis=1)
    return tuple(pattern[:, ids] for pattern in patterns)


def _check_chain(patterns, ids):
    for k, pattern in enumerate(patterns):
        if np.ndim(pattern) != 2 or np.shape(pattern)[1:] != np.shape(patterns[0])[1:]:
            raise ValueError(f"patterns[{k}] has shape {np.shape(pattern)}")
    _check_indices("ids", ids)
    if len(patterns) and not (ids < np.shape(patterns[0])[1]).all():
        raise ValueError("ids must be < s")
