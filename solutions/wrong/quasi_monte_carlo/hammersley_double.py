"""Double precision."""

import numpy as np

FUNCTION = "hammersley"
CAUGHT_BY = "contract"
MISTAKE = "other-dtype"


def hammersley(n, dims):
    """With a mistake."""
    if not n >= 0:
        raise ValueError(f"n must be >= 0, got {n}")
    _check_dims(dims)
    i = np.arange(n)
    first = i / max(n, 1)
    return np.stack([first, *(_mirrored(base, i) for base in _primes(dims - 1))])
