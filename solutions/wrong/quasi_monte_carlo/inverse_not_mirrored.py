"""The digits in their old order."""

import numpy as np

FUNCTION = "radical_inverse"
CAUGHT_BY = "exact"
MISTAKE = "not-mirrored"
SAYS = "Your digits stand behind the point in the order in which they stood before it."


def radical_inverse(base, i):
    """With a mistake."""
    _check_inverse(base, i)
    value = np.zeros(len(i), np.float32)
    for k, number in enumerate(i.tolist()):
        size = 1
        while size <= number:
            size *= base
        value[k] = number / size
    return value


def _check_inverse(base, i):
    if not base >= 2 or base != int(base):
        raise ValueError(f"base must be an integer >= 2, got {base}")
    _check_indices("i", i)
