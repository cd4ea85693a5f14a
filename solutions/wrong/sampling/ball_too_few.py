"""What is accepted of n candidates."""

import numpy as np

FUNCTION = "ball_by_rejection"
CAUGHT_BY = "contract"
MISTAKE = "ball-too-few"
SAYS = "You draw n candidates and return those that are accepted: fewer than n."


def ball_by_rejection(n, rng):
    """Points by rejection."""
    _check_count(n)
    points = 2 * rng.random((3, n), np.float32) - 1
    return points[:, np.linalg.norm(points, axis=0) <= 1]
