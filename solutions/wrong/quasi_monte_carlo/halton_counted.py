"""Numbers from 0 up, whatever i is."""

import numpy as np

FUNCTION = "halton"
CAUGHT_BY = "exact"
MISTAKE = "numbers-ignored"
SAYS = "You number the points from 0 up; i says which points are wanted."


def halton(i, dims):
    """With a mistake."""
    _check_indices("i", i)
    _check_dims(dims)
    return np.stack([_mirrored(base, np.arange(len(i))) for base in _primes(dims)])
