"""Points inside, too."""

import numpy as np

FUNCTION = "point_on_sphere"
CAUGHT_BY = "radius"
MISTAKE = "sphere-filled"
SAYS = "Your points fill the inside of the sphere; they belong on its surface."

_right = point_on_sphere


def point_on_sphere(center, radius, u):
    """Uniform points on a sphere."""
    points = _right(np.zeros(3), radius, u) * np.cbrt(u[0] * 7919 % 1)
    return points + _column(center, u.dtype)
