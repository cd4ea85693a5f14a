"""Double precision whatever comes."""

import numpy as np

FUNCTION = "point_on_facing_disk"
CAUGHT_BY = "contract"
MISTAKE = "other-dtype"

_right = point_on_facing_disk


def point_on_facing_disk(center, radius, point, u):
    """Uniform points on the disk that faces each point."""
    return _right(center, radius, point, u).astype(np.float64)
