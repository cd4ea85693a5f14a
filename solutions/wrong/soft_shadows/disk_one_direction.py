"""One row of u alone is used, and used for all."""

import numpy as np

FUNCTION = "point_on_facing_disk"
CAUGHT_BY = "uniform"
MISTAKE = "facing-one-number"
SAYS = "The same number decides radius and angle: the points lie on a curve in the disk."

_right = point_on_facing_disk


def point_on_facing_disk(center, radius, point, u):
    """Uniform points on the disk that faces each point."""
    _check_batch("u", u, 2)
    return _right(center, radius, point, np.repeat(u[:1], len(u), axis=0))
