"""Double precision whatever comes."""

import numpy as np

FUNCTION = "point_on_sphere"
CAUGHT_BY = "contract"
MISTAKE = "point-on-sphere-float64"
SAYS = "Your result is float64 for float32 numbers; see what single points and constants do to the dtype."

_right = point_on_sphere


def point_on_sphere(center, radius, u):
    """Uniform points on a sphere."""
    return _right(center, radius, u).astype(np.float64)
