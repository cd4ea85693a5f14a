"""The number 0 gives no direction."""

import numpy as np

FUNCTION = "sphere_by_polar"
CAUGHT_BY = "at_the_ends"
MISTAKE = None


def sphere_by_polar(u):
    """With a mistake."""
    _check_batch("u", u, 2)
    return np.where(u[0] == 0, 0, _on_sphere(u)).astype(u.dtype)
