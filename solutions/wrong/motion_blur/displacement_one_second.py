"""The way of one second, at every time."""

import numpy as np

FUNCTION = "displacement"
CAUGHT_BY = "linear"
MISTAKE = "gone-at-once"
SAYS = "Your object has gone the way of one second at every time."


def displacement(velocity, time):
    """How far an object has gone."""
    _check_single(velocity=velocity)
    _check_scalars("time", time)
    return np.asarray(velocity, time.dtype)[:, None] * np.ones_like(time)
