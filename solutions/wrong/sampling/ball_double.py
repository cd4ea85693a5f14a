"""Double precision all the way."""

import numpy as np

FUNCTION = "ball_by_rejection"
CAUGHT_BY = "contract"
MISTAKE = "other-dtype"


def ball_by_rejection(n, rng):
    """Points by rejection."""
    _check_count(n)
    points = np.empty((3, 0))
    while points.shape[1] < n:
        more = rng.uniform(-1, 1, (3, n))
        points = np.concatenate((points, more[:, (more * more).sum(axis=0) <= 1]), axis=1)
    return points[:, :n]
