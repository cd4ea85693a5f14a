"""From point 1 on."""

import numpy as np

FUNCTION = "halton"
CAUGHT_BY = "exact"
MISTAKE = "next-point"
SAYS = "You give the point that follows: point 0 has all coordinates 0."


def halton(i, dims):
    """With a mistake."""
    _check_indices("i", i)
    _check_dims(dims)
    return np.stack([_mirrored(base, i.astype(np.int64) + 1) for base in _primes(dims)])
