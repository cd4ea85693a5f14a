"""The whole cube, none of it rejected."""

import numpy as np

FUNCTION = "ball_by_rejection"
CAUGHT_BY = "inside"
MISTAKE = "ball-not-rejected"
SAYS = "Your points fill the whole cube: those outside the ball are never rejected."


def ball_by_rejection(n, rng):
    """Points by rejection."""
    _check_count(n)
    return 2 * rng.random((3, n), np.float32) - 1
