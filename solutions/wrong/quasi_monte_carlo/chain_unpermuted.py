"""The id itself."""

import numpy as np

FUNCTION = "chain"
CAUGHT_BY = "from_rng"
MISTAKE = "not-permuted"
SAYS = (
    "Your ray takes the sample of its own id from each pattern: the effects are tied to each other."
)


def chain(patterns, ids, rng):
    """With a mistake."""
    _check_chain(patterns, ids)
    return tuple(pattern[:, ids] for pattern in patterns)


def _check_chain(patterns, ids):
    for k, pattern in enumerate(patterns):
        if np.ndim(pattern) != 2 or np.shape(pattern)[1:] != np.shape(patterns[0])[1:]:
            raise ValueError(f"patterns[{k}] has shape {np.shape(pattern)}")
    _check_indices("ids", ids)
    if len(patterns) and not (ids < np.shape(patterns[0])[1]).all():
        raise ValueError("ids must be < s")
