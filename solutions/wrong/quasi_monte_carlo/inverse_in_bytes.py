"""Numbers of few bits are mirrored in as few."""

import numpy as np

FUNCTION = "radical_inverse"
CAUGHT_BY = "small_kinds"
MISTAKE = None


def radical_inverse(base, i):
    """With a mistake."""
    if not base >= 2 or base != int(base):
        raise ValueError(f"base must be an integer >= 2, got {base}")
    _check_indices("i", i)
    return _mirrored(base, i * i.dtype.type(1) << i.dtype.type(1) >> i.dtype.type(1))
