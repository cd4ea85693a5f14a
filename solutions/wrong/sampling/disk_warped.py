"""The polar warp, where rejection is asked for."""

import numpy as np

FUNCTION = "disk_by_rejection"
CAUGHT_BY = "acceptance"
MISTAKE = "disk-no-rejection"
SAYS = "Your points are uniform, but you draw too few numbers to have rejected any: this is a warp."


def disk_by_rejection(n, rng):
    """Points by rejection."""
    _check_count(n)
    return disk_by_polar(rng.random((2, n), np.float32))
