"""Numbers from 0 to 1 taken as coordinates."""

import numpy as np

FUNCTION = "disk_by_rejection"
CAUGHT_BY = "uniform"
MISTAKE = "disk-one-corner"
SAYS = "All coordinates are positive: your square reaches from 0 to 1, not from -1."


def disk_by_rejection(n, rng):
    """Points by rejection."""
    _check_count(n)
    points = np.empty((2, 0), np.float32)
    while points.shape[1] < n:
        more = rng.random((2, n), np.float32)
        points = np.concatenate((points, more[:, np.hypot(*more) <= 1]), axis=1)
    return points[:, :n]
