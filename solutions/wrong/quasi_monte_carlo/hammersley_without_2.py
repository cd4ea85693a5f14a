"""Base 2 left out."""

import numpy as np

FUNCTION = "hammersley"
CAUGHT_BY = "exact"
MISTAKE = "base-2-skipped"
SAYS = "You skip base 2: after the coordinate that counts, the primes begin with 2."


def hammersley(n, dims):
    """With a mistake."""
    if not n >= 0:
        raise ValueError(f"n must be >= 0, got {n}")
    _check_dims(dims)
    i = np.arange(n)
    first = (i / max(n, 1)).astype(np.float32)
    return np.stack([first, *(_mirrored(base, i) for base in _primes(dims)[1:])])
