"""Only 25 primes are known, and then they begin again."""

import numpy as np

FUNCTION = "halton"
CAUGHT_BY = "many_primes"
MISTAKE = None


def halton(i, dims):
    """With a mistake."""
    _check_indices("i", i)
    _check_dims(dims)
    return np.stack(
        [_mirrored(base, i) for base in (_primes(min(dims, 25)) * (dims // 25 + 1))[:dims]]
    )
