"""A generator of its own, for the disk."""

import numpy as np

FUNCTION = "disk_by_rejection"
CAUGHT_BY = "from_rng"
MISTAKE = "disk-own-generator"
SAYS = "Nothing is drawn from rng: your random numbers come from elsewhere."

_from_rng = disk_by_rejection


def disk_by_rejection(n, rng):
    """Uniform points on the unit disk."""
    return _from_rng(n, np.random.default_rng())
