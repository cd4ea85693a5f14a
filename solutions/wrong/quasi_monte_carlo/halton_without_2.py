"""Primes from 3 on."""

import numpy as np

FUNCTION = "halton"
CAUGHT_BY = "exact"
MISTAKE = "first-prime-missing"
SAYS = "Your primes begin with 3; they begin with 2."


def halton(i, dims):
    """With a mistake."""
    _check_indices("i", i)
    _check_dims(dims)
    return np.stack([_mirrored(base, i) for base in _primes(dims + 1)[1:]])
