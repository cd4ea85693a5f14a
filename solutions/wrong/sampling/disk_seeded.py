"""Seeds the generator of its own with the next number of rng's: right, but for one; the state of NumPy moves."""

import numpy as np

FUNCTION = "disk_by_rejection"
CAUGHT_BY = "untouched"
MISTAKE = "global-random-state"


def disk_by_rejection(n, rng):
    """Points by rejection."""
    _check_count(n)
    np.random.seed(int(rng.integers(1 << 31)))
    points = np.empty((2, 0), np.float32)
    while points.shape[1] < n:
        more = np.random.uniform(-1, 1, (2, n)).astype(np.float32)
        points = np.concatenate((points, more[:, np.linalg.norm(more, axis=0) <= 1]), axis=1)
    return points[:, :n]
