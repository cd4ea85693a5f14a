"""The centre in the place of each point that was rejected."""

import numpy as np

FUNCTION = "ball_by_rejection"
CAUGHT_BY = "uniform"
MISTAKE = "ball-left-at-centre"
SAYS = "Where a point was rejected you leave the centre of the ball instead of drawing anew."


def ball_by_rejection(n, rng):
    """Points by rejection."""
    _check_count(n)
    points = 2 * rng.random((3, n), np.float32) - 1
    return np.where((points * points).sum(axis=0) <= 1, points, np.float32(0))
