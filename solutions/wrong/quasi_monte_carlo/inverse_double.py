"""Double precision."""

import numpy as np

FUNCTION = "radical_inverse"
CAUGHT_BY = "contract"
MISTAKE = "inverse-float64"
SAYS = "Your result is float64; coordinates are float32 here."


def radical_inverse(base, i):
    """With a mistake."""
    _check_inverse(base, i)
    return _mirrored(base, i).astype(np.float64)


def _check_inverse(base, i):
    if not base >= 2 or base != int(base):
        raise ValueError(f"base must be an integer >= 2, got {base}")
    _check_indices("i", i)
