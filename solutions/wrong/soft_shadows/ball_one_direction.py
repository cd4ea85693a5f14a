"""One row of u alone is used, and used for all."""

import numpy as np

FUNCTION = "point_in_ball"
CAUGHT_BY = "uniform"
MISTAKE = None

_right = point_in_ball


def point_in_ball(center, radius, u):
    """Uniform points in a ball."""
    _check_batch("u", u, 3)
    return _right(center, radius, np.repeat(u[:1], len(u), axis=0))
