"""The centre in the place of each point that was rejected."""

import numpy as np

FUNCTION = "disk_by_rejection"
CAUGHT_BY = "uniform"
MISTAKE = "disk-left-at-centre"
SAYS = "Where a point was rejected you leave the centre of the disk instead of drawing anew."


def disk_by_rejection(n, rng):
    """Points by rejection."""
    _check_count(n)
    points = 2 * rng.random((2, n), np.float32) - 1
    return np.where(np.hypot(*points) <= 1, points, np.float32(0))
