"""The largest prime first."""

import numpy as np

FUNCTION = "halton"
CAUGHT_BY = "exact"
MISTAKE = "reversed"
SAYS = "Your coordinates come in the reverse order: the first has base 2."


def halton(i, dims):
    """With a mistake."""
    _check_indices("i", i)
    _check_dims(dims)
    return np.stack([_mirrored(base, i) for base in _primes(dims)[::-1]])
