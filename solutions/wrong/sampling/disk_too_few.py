"""What is accepted of n candidates."""

import numpy as np

FUNCTION = "disk_by_rejection"
CAUGHT_BY = "contract"
MISTAKE = "disk-too-few"
SAYS = "You draw n candidates and return those that are accepted: fewer than n."


def disk_by_rejection(n, rng):
    """Points by rejection."""
    _check_count(n)
    points = 2 * rng.random((2, n), np.float32) - 1
    return points[:, np.hypot(*points) <= 1]
