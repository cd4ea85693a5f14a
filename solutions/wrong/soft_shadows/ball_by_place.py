"""Goes by the place in the batch, evenly over the light, whatever u is."""

import numpy as np

FUNCTION = "point_in_ball"
CAUGHT_BY = "uniform"
MISTAKE = "not-by-its-column"

_right = point_in_ball


def point_in_ball(center, radius, u):
    """Uniform points in a ball."""
    _check_batch("u", u, 3)
    n = u.shape[1]
    steps = np.arange(n)[None] * np.sqrt([[2], [3], [5]])
    own = (steps % 1).astype(u.dtype)
    return _right(center, radius, own[: len(u)])
