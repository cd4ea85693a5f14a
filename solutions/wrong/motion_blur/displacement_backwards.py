"""The object moves against its velocity."""

import numpy as np

FUNCTION = "displacement"
CAUGHT_BY = "one-second"
MISTAKE = "against-velocity"
SAYS = "Your object moves against its velocity; a sign is the wrong way round."


def displacement(velocity, time):
    """How far an object has gone."""
    _check_single(velocity=velocity)
    _check_scalars("time", time)
    velocity = np.asarray(velocity, time.dtype)
    return -velocity[:, None] * time
