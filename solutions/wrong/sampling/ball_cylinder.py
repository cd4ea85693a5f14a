"""Rejected by x and y alone: a cylinder."""

import numpy as np

FUNCTION = "ball_by_rejection"
CAUGHT_BY = "inside"
MISTAKE = "cylinder"
SAYS = "Two of three coordinates decide what is rejected: the points fill a cylinder."


def ball_by_rejection(n, rng):
    """Points by rejection."""
    _check_count(n)
    points = np.empty((3, 0), np.float32)
    while points.shape[1] < n:
        more = 2 * rng.random((3, n), np.float32) - 1
        points = np.concatenate((points, more[:, np.hypot(*more[:2]) <= 1]), axis=1)
    return points[:, :n]
