"""The first column's numbers for all."""

import numpy as np

FUNCTION = "point_in_ball"
CAUGHT_BY = "uniform"
MISTAKE = "ball-one-point"
SAYS = "All your points are one: every column of u has a point of its own."

_right = point_in_ball


def point_in_ball(center, radius, u):
    """Uniform points in a ball."""
    return _right(center, radius, np.repeat(u[:, :1], u.shape[1], axis=1))
