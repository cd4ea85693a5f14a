"""The last digit alone."""

import numpy as np

FUNCTION = "radical_inverse"
CAUGHT_BY = "exact"
MISTAKE = "last-digit"
SAYS = "You mirror the last digit alone; the others follow behind it."


def radical_inverse(base, i):
    """With a mistake."""
    _check_inverse(base, i)
    return (i % base / base).astype(np.float32)


def _check_inverse(base, i):
    if not base >= 2 or base != int(base):
        raise ValueError(f"base must be an integer >= 2, got {base}")
    _check_indices("i", i)
