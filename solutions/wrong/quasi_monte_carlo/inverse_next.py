"""That of the next number."""

import numpy as np

FUNCTION = "radical_inverse"
CAUGHT_BY = "exact"
MISTAKE = "one-too-far"
SAYS = "You give the radical inverse of i + 1."


def radical_inverse(base, i):
    """With a mistake."""
    _check_inverse(base, i)
    return _mirrored(base, i.astype(np.int64) + 1)


def _check_inverse(base, i):
    if not base >= 2 or base != int(base):
        raise ValueError(f"base must be an integer >= 2, got {base}")
    _check_indices("i", i)
