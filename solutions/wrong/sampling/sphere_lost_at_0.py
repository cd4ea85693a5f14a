"""Numbers at either end of [0, 1) give no direction."""

import numpy as np

FUNCTION = "sphere_by_polar"
CAUGHT_BY = "at_the_ends"
MISTAKE = None


def sphere_by_polar(u):
    """With a mistake."""
    _check_batch("u", u, 2)
    at_an_end = np.abs(u[0] - 0.5) > 0.5 - 1e-7
    return np.where(at_an_end, 0, _on_sphere(u)).astype(u.dtype)
