"""The first coordinate reaches 1."""

import numpy as np

FUNCTION = "hammersley"
CAUGHT_BY = "first"
MISTAKE = "up-to-1"
SAYS = "Your first coordinate is i / (n - 1), which reaches 1."


def hammersley(n, dims):
    """With a mistake."""
    if not n >= 0:
        raise ValueError(f"n must be >= 0, got {n}")
    _check_dims(dims)
    i = np.arange(n)
    first = (i / max(n - 1, 1)).astype(np.float32)
    return np.stack([first, *(_mirrored(base, i) for base in _primes(dims - 1))])
