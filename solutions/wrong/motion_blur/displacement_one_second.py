"""The way of one second, at every time."""

import numpy as np

FUNCTION = "displacement"
CAUGHT_BY = "linear"
MISTAKE = None


def displacement(velocity, time):
    """How far an object has gone."""
    _check_single(velocity=velocity)
    _check_scalars("time", time)
    return np.asarray(velocity, time.dtype)[:, None] * np.ones_like(time)
