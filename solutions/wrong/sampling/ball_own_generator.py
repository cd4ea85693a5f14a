"""A generator of its own instead of the given one."""

import numpy as np

FUNCTION = "ball_by_rejection"
CAUGHT_BY = "from_rng"
MISTAKE = "ball-own-generator"
SAYS = "Nothing is drawn from rng: your random numbers come from elsewhere."


def ball_by_rejection(n, rng):
    """Points by rejection."""
    _check_count(n)
    rng = np.random.default_rng(7)
    return _by_rejection(3, n, np.pi / 6, rng)
