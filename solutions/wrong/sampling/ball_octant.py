"""Numbers from 0 to 1 taken as coordinates."""

import numpy as np

FUNCTION = "ball_by_rejection"
CAUGHT_BY = "uniform"
MISTAKE = "ball-one-corner"
SAYS = "All coordinates are positive: your cube reaches from 0 to 1, not from -1."


def ball_by_rejection(n, rng):
    """Points by rejection."""
    _check_count(n)
    return np.abs(_by_rejection(3, n, np.pi / 6, rng))
