"""The angle is in degrees, its cosine takes radians."""

import numpy as np

FUNCTION = "point_on_sphere"
CAUGHT_BY = "smooth"
MISTAKE = "sphere-degrees"
SAYS = "Your angle is in degrees, but cosine and sine take radians: neighbouring u go to places far apart."

_right = point_on_sphere


def point_on_sphere(center, radius, u):
    """Uniform points on a sphere."""
    turned = np.array(u)
    turned[1] = turned[1] * u.dtype.type(180 / np.pi) % 1
    return _right(center, radius, turned)
