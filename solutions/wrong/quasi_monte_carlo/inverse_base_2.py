"""Base 2 always."""

import numpy as np

FUNCTION = "radical_inverse"
CAUGHT_BY = "exact"
MISTAKE = "always-base-2"
SAYS = "Your base is 2, whichever is asked for."


def radical_inverse(base, i):
    """With a mistake."""
    _check_inverse(base, i)
    return _mirrored(2, i)


def _check_inverse(base, i):
    if not base >= 2 or base != int(base):
        raise ValueError(f"base must be an integer >= 2, got {base}")
    _check_indices("i", i)
