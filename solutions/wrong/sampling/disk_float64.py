"""Double precision, whatever comes."""

import numpy as np

FUNCTION = "disk_by_polar"
CAUGHT_BY = "contract"
MISTAKE = "disk-float64"
SAYS = "Your result is float64 for float32 numbers; it should have the dtype of u."

_right = disk_by_polar


def disk_by_polar(u):
    """A polar warp."""
    return _right(u).astype(np.float64)
