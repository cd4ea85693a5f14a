"""Points outside are moved to the rim."""

import numpy as np

FUNCTION = "disk_by_rejection"
CAUGHT_BY = "uniform"
MISTAKE = "disk-pushed-to-rim"
SAYS = "Points outside the disk are moved to its rim instead of being drawn anew, so the rim is crowded."


def disk_by_rejection(n, rng):
    """Points by rejection."""
    _check_count(n)
    points = 2 * rng.random((2, n), np.float32) - 1
    return points / np.maximum(np.hypot(*points), np.float32(1))
