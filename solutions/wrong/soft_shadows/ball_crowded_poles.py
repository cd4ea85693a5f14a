"""A uniform polar angle: directions crowd at the poles."""

import numpy as np

FUNCTION = "point_in_ball"
CAUGHT_BY = "uniform"
MISTAKE = "ball-crowded-poles"
SAYS = "Your polar angle is uniform, so the points crowd at the two poles."

_right = point_in_ball


def point_in_ball(center, radius, u):
    """Uniform points in a ball."""
    even = np.array(u)
    even[0] = (1 - np.cos(np.pi * u[0])) / 2
    return _right(center, radius, even)
