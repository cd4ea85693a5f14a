"""Nothing has moved before time 0."""

import numpy as np

FUNCTION = "displacement"
CAUGHT_BY = "linear"
MISTAKE = "only-after-the-start"
SAYS = "Before time 0 your object stands still; it moves at all times, and earlier it was on the other side."


def displacement(velocity, time):
    """How far an object has gone."""
    _check_single(velocity=velocity)
    _check_scalars("time", time)
    return np.asarray(velocity, time.dtype)[:, None] * np.maximum(time, 0)
