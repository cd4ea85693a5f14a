"""Normalises the velocity as if it were a direction."""

import numpy as np

FUNCTION = "displacement"
CAUGHT_BY = "one-second"
MISTAKE = "unit-speed"
SAYS = "Your object always moves at 1 m/s; the velocity's length is its speed and must stay."


def displacement(velocity, time):
    """How far an object has gone."""
    _check_single(velocity=velocity)
    _check_scalars("time", time)
    velocity = np.asarray(velocity, time.dtype)
    length = np.linalg.norm(velocity)
    if length > 0:
        velocity = velocity / length
    return velocity[:, None] * time
