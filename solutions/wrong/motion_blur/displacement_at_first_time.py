"""Moves the object by the way of the first ray's time, for all rays."""

import numpy as np

FUNCTION = "displacement"
CAUGHT_BY = "linear"
MISTAKE = "gone-at-first-time"
SAYS = "You use the first ray's time for all rays; each has its own."


def displacement(velocity, time):
    """How far an object has gone."""
    _check_single(velocity=velocity)
    _check_scalars("time", time)
    velocity = np.asarray(velocity, time.dtype)
    if len(time) == 0:
        return np.zeros((3, 0), time.dtype)
    return np.repeat((velocity * time[0])[:, None], len(time), axis=1)
