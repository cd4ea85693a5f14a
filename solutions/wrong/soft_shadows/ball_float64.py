"""Double precision whatever comes."""

import numpy as np

FUNCTION = "point_in_ball"
CAUGHT_BY = "contract"
MISTAKE = "point-in-ball-float64"
SAYS = "Your result is float64 for float32 numbers; see what single points and constants do to the dtype."

_right = point_in_ball


def point_in_ball(center, radius, u):
    """Uniform points in a ball."""
    return _right(center, radius, u).astype(np.float64)
