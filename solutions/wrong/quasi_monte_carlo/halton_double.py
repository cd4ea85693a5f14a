"""Double precision."""

import numpy as np

FUNCTION = "halton"
CAUGHT_BY = "contract"
MISTAKE = "other-dtype"


def halton(i, dims):
    """With a mistake."""
    _check_indices("i", i)
    _check_dims(dims)
    return np.stack([_mirrored(base, i) for base in _primes(dims)]).astype(np.float64)
