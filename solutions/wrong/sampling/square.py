"""The square's points, none of them rejected."""

import numpy as np

FUNCTION = "disk_by_rejection"
CAUGHT_BY = "inside"
MISTAKE = "disk-not-rejected"
SAYS = "Your points fill the whole square: those outside the disk are never rejected."


def disk_by_rejection(n, rng):
    """Points by rejection."""
    _check_count(n)
    return 2 * rng.random((2, n), np.float32) - 1
