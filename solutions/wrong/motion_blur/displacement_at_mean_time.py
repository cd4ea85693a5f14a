"""Moves the object by the way of the mean time, for all rays."""

import numpy as np

FUNCTION = "displacement"
CAUGHT_BY = "linear"
MISTAKE = "gone-at-mean-time"
SAYS = "You use the mean time for all rays, which moves the object but leaves no streak; each ray has a time of its own."


def displacement(velocity, time):
    """How far an object has gone."""
    _check_single(velocity=velocity)
    _check_scalars("time", time)
    velocity = np.asarray(velocity, time.dtype)
    if len(time) == 0:
        return np.zeros((3, 0), time.dtype)
    return np.repeat((velocity * time.mean())[:, None], len(time), axis=1)
