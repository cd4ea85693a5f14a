"""2 and the odd numbers."""

import numpy as np

FUNCTION = "halton"
CAUGHT_BY = "exact"
MISTAKE = "odd-bases"
SAYS = "Your bases are 2 and the odd numbers; 9 is one, but it is no prime."


def halton(i, dims):
    """With a mistake."""
    _check_indices("i", i)
    _check_dims(dims)
    return np.stack([_mirrored(base, i) for base in [2, *range(3, 2 * dims + 1, 2)][:dims]])
