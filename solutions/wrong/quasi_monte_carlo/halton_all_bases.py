"""2, 3, 4, 5, ..."""

import numpy as np

FUNCTION = "halton"
CAUGHT_BY = "exact"
MISTAKE = "bases-not-prime"
SAYS = (
    "Your bases are 2, 3, 4, 5, ...: where they share a factor, coordinates are tied to each other."
)


def halton(i, dims):
    """With a mistake."""
    _check_indices("i", i)
    _check_dims(dims)
    return np.stack([_mirrored(base, i) for base in range(2, dims + 2)])
