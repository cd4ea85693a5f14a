"""Each row permuted by itself."""

import numpy as np

FUNCTION = "chain"
CAUGHT_BY = "samples"
MISTAKE = "coordinates-torn-apart"
SAYS = "Each row has a permutation of its own, which tears the coordinates of a sample apart."


def chain(patterns, ids, rng):
    """With a mistake."""
    _check_chain(patterns, ids)
    return tuple(rng.permuted(pattern, axis=1)[:, ids] for pattern in patterns)


def _check_chain(patterns, ids):
    for k, pattern in enumerate(patterns):
        if np.ndim(pattern) != 2 or np.shape(pattern)[1:] != np.shape(patterns[0])[1:]:
            raise ValueError(f"patterns[{k}] has shape {np.shape(pattern)}")
    _check_indices("ids", ids)
    if len(patterns) and not (ids < np.shape(patterns[0])[1]).all():
        raise ValueError("ids must be < s")
