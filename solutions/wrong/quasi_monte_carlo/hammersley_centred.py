"""Centres in the first coordinate."""

import numpy as np

FUNCTION = "hammersley"
CAUGHT_BY = "first"
MISTAKE = "centred"
SAYS = "Your first coordinate is (i + 1/2) / n; here it is i / n."


def hammersley(n, dims):
    """With a mistake."""
    if not n >= 0:
        raise ValueError(f"n must be >= 0, got {n}")
    _check_dims(dims)
    i = np.arange(n)
    first = ((i + 0.5) / max(n, 1)).astype(np.float32)
    return np.stack([first, *(_mirrored(base, i) for base in _primes(dims - 1))])
