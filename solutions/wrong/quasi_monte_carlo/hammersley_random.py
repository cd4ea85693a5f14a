"""Random points."""

import numpy as np

FUNCTION = "hammersley"
CAUGHT_BY = "exact"
MISTAKE = "hammersley-random"
SAYS = "The points are random numbers; those of this set are worked out from their index."


def hammersley(n, dims):
    """With a mistake."""
    if not n >= 0:
        raise ValueError(f"n must be >= 0, got {n}")
    _check_dims(dims)
    return np.random.default_rng(0).random((dims, n), np.float32)
