"""One row of u alone is used, and used for all."""

import numpy as np

FUNCTION = "point_in_ball"
CAUGHT_BY = "uniform"
MISTAKE = "ball-one-number"
SAYS = "The same number decides radius and angles: the points lie on a curve in the ball."

_right = point_in_ball


def point_in_ball(center, radius, u):
    """Uniform points in a ball."""
    _check_batch("u", u, 3)
    return _right(center, radius, np.repeat(u[:1], len(u), axis=0))
