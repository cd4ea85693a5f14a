"""The coordinate that counts comes last."""

import numpy as np

FUNCTION = "hammersley"
CAUGHT_BY = "exact"
MISTAKE = "counts-last"
SAYS = "Your coordinate that counts comes last; it is the first."


def hammersley(n, dims):
    """With a mistake."""
    if not n >= 0:
        raise ValueError(f"n must be >= 0, got {n}")
    _check_dims(dims)
    i = np.arange(n)
    last = (i / max(n, 1)).astype(np.float32)
    return np.stack([*(_mirrored(base, i) for base in _primes(dims - 1)), last])
