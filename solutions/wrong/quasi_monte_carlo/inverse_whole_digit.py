"""The first digit before the point."""

import numpy as np

FUNCTION = "radical_inverse"
CAUGHT_BY = "exact"
MISTAKE = "first-digit-whole"
SAYS = "Your first digit stands before the point: the numbers are base times too large."


def radical_inverse(base, i):
    """With a mistake."""
    _check_inverse(base, i)
    return _mirrored(base, i) * np.float32(base)


def _check_inverse(base, i):
    if not base >= 2 or base != int(base):
        raise ValueError(f"base must be an integer >= 2, got {base}")
    _check_indices("i", i)
