"""The first column's numbers for all."""

import numpy as np

FUNCTION = "point_on_facing_disk"
CAUGHT_BY = "uniform"
MISTAKE = "disk-one-point"
SAYS = "All your points are one: every column of u has a point of its own."

_right = point_on_facing_disk


def point_on_facing_disk(center, radius, point, u):
    """Uniform points on the disk that faces each point."""
    return _right(center, radius, point, np.repeat(u[:, :1], u.shape[1], axis=1))
