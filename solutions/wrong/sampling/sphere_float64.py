"""Double precision, whatever comes."""

import numpy as np

FUNCTION = "sphere_by_polar"
CAUGHT_BY = "contract"
MISTAKE = "sphere-float64"
SAYS = "Your result is float64 for float32 numbers; it should have the dtype of u."

_right = sphere_by_polar


def sphere_by_polar(u):
    """A polar warp."""
    return _right(u).astype(np.float64)
