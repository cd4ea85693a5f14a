"""Every call of as many points returns the same array."""

import numpy as np

FUNCTION = "sphere_by_polar"
CAUGHT_BY = "untouched"
MISTAKE = "overwrites-results"

_kept = {}


def sphere_by_polar(u):
    """With a mistake."""
    _check_batch("u", u, 2)
    out = _kept.setdefault((u.shape, u.dtype), np.empty((3, u.shape[1]), u.dtype))
    out[:] = _on_sphere(u)
    return out
