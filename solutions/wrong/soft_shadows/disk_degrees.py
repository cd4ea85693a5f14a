"""The angle is in degrees, its cosine takes radians."""

import numpy as np

FUNCTION = "point_on_facing_disk"
CAUGHT_BY = "smooth"
MISTAKE = "facing-degrees"
SAYS = "A full turn is 360 where the cosine takes radians: neighbouring numbers land far apart."

_right = point_on_facing_disk


def point_on_facing_disk(center, radius, point, u):
    """Uniform points on the disk that faces each point."""
    turned = np.array(u)
    turned[1] = turned[1] * u.dtype.type(180 / np.pi) % 1
    return _right(center, radius, point, turned)
