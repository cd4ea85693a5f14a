"""A point a row."""

import numpy as np

FUNCTION = "halton"
CAUGHT_BY = "contract"
MISTAKE = "halton-rows"
SAYS = "A point stands in each row; the agreed shape has one in each column."


def halton(i, dims):
    """With a mistake."""
    _check_indices("i", i)
    _check_dims(dims)
    return np.stack([_mirrored(base, i) for base in _primes(dims)], axis=1)
