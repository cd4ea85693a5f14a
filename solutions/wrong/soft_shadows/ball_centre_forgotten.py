"""The light's centre is not added."""

import numpy as np

FUNCTION = "point_in_ball"
CAUGHT_BY = "inside"
MISTAKE = "ball-centre-forgotten"
SAYS = "Your points lie about the origin of the scene; the light is somewhere else."

_right = point_in_ball


def point_in_ball(center, radius, u):
    """Uniform points in a ball."""
    points = _right(center, radius, u)
    return points - np.asarray(center, points.dtype)[:, None]
