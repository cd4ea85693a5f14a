"""The polar warp, where rejection is asked for."""

import numpy as np

FUNCTION = "ball_by_rejection"
CAUGHT_BY = "acceptance"
MISTAKE = "ball-no-rejection"
SAYS = "Your points are uniform, but you draw too few numbers to have rejected any: this is a warp."


def ball_by_rejection(n, rng):
    """Points by rejection."""
    _check_count(n)
    return ball_by_polar(rng.random((3, n), np.float32))
