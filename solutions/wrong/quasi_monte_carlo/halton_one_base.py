"""Base 2 for each coordinate."""

import numpy as np

FUNCTION = "halton"
CAUGHT_BY = "exact"
MISTAKE = "one-base"
SAYS = "All your coordinates have the same base, so the points lie on the diagonal."


def halton(i, dims):
    """With a mistake."""
    _check_indices("i", i)
    _check_dims(dims)
    return np.stack([_mirrored(base, i) for base in [2] * dims])
