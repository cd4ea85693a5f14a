"""Halton's points."""

import numpy as np

FUNCTION = "hammersley"
CAUGHT_BY = "exact"
MISTAKE = "halton-instead"
SAYS = "These are Halton's points: the first coordinate should be i / n."


def hammersley(n, dims):
    """With a mistake."""
    if not n >= 0:
        raise ValueError(f"n must be >= 0, got {n}")
    _check_dims(dims)
    return halton(np.arange(n), dims)
