"""Half a turn."""

import numpy as np

FUNCTION = "point_on_facing_disk"
CAUGHT_BY = "uniform"
MISTAKE = "facing-half-turn"
SAYS = "The angle runs over half a turn, so half of the disk gets no point."

_right = point_on_facing_disk


def point_on_facing_disk(center, radius, point, u):
    """Uniform points on the disk that faces each point."""
    half = np.array(u)
    half[1] = u[1] / 2
    return _right(center, radius, point, half)
