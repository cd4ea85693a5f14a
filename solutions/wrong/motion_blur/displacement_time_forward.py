"""Takes the time without its sign."""

import numpy as np

FUNCTION = "displacement"
CAUGHT_BY = "linear"
MISTAKE = "time-without-sign"
SAYS = (
    "You use only how long ago or ahead a time is: before time 0 an object was on the other side."
)


def displacement(velocity, time):
    """How far an object has gone."""
    _check_single(velocity=velocity)
    _check_scalars("time", time)
    return np.asarray(velocity, time.dtype)[:, None] * np.abs(time)
