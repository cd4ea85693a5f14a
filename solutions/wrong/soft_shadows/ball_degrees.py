"""The angle is in degrees, its cosine takes radians."""

import numpy as np

FUNCTION = "point_in_ball"
CAUGHT_BY = "smooth"
MISTAKE = "ball-degrees"
SAYS = "Your angle is in degrees, but cosine and sine take radians: neighbouring u go to places far apart."

_right = point_in_ball


def point_in_ball(center, radius, u):
    """Uniform points in a ball."""
    turned = np.array(u)
    turned[1] = turned[1] * u.dtype.type(180 / np.pi) % 1
    return _right(center, radius, turned)
