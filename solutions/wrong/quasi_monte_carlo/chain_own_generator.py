"""Permutations from a generator of its own."""

import numpy as np

FUNCTION = "chain"
CAUGHT_BY = "from_rng"
MISTAKE = "own-generator"
SAYS = "Two generators with the same seed give you different samples: the permutations come from somewhere other than the generator that is handed in."


def chain(patterns, ids, rng):  # noqa: ARG001
    """With a mistake."""
    _check_chain(patterns, ids)
    own = np.random.default_rng()
    return tuple(pattern[:, own.permutation(pattern.shape[1])[ids]] for pattern in patterns)


def _check_chain(patterns, ids):
    for k, pattern in enumerate(patterns):
        if np.ndim(pattern) != 2 or np.shape(pattern)[1:] != np.shape(patterns[0])[1:]:
            raise ValueError(f"patterns[{k}] has shape {np.shape(pattern)}")
    _check_indices("ids", ids)
    if len(patterns) and not (ids < np.shape(patterns[0])[1]).all():
        raise ValueError("ids must be < s")
