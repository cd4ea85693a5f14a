"""The light's centre is not added."""

import numpy as np

FUNCTION = "point_on_facing_disk"
CAUGHT_BY = "inside"
MISTAKE = "disk-centre-forgotten"
SAYS = "Your points lie about the origin of the scene; the light is somewhere else."

_right = point_on_facing_disk


def point_on_facing_disk(center, radius, point, u):
    """Uniform points on the disk that faces each point."""
    points = _right(center, radius, point, u)
    return points - np.asarray(center, points.dtype)[:, None]
