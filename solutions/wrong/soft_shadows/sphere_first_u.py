"""The first column's numbers for all."""

import numpy as np

FUNCTION = "point_on_sphere"
CAUGHT_BY = "uniform"
MISTAKE = "sphere-one-point"
SAYS = "All your points are one: every column of u has a point of its own."

_right = point_on_sphere


def point_on_sphere(center, radius, u):
    """Uniform points on a sphere."""
    return _right(center, radius, np.repeat(u[:, :1], u.shape[1], axis=1))
