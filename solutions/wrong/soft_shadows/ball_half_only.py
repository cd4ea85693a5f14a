"""Heights from 0 to 1: the upper half of the ball only."""

import numpy as np

FUNCTION = "point_in_ball"
CAUGHT_BY = "uniform"
MISTAKE = "half-ball"
SAYS = "Only one half of the ball gets points."

_right = point_in_ball


def point_in_ball(center, radius, u):
    """Uniform points in a ball."""
    upper = np.array(u)
    upper[0] = u[0] / 2
    return _right(center, radius, upper)
