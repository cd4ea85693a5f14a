"""The dtype is that of the velocity."""

import numpy as np

FUNCTION = "displacement"
CAUGHT_BY = "contract"
MISTAKE = "displacement-float64"
SAYS = "Your result is float64 for float32 times: a velocity of float64 makes it so, though it is one for all rays."


def displacement(velocity, time):
    """How far an object has gone."""
    _check_single(velocity=velocity)
    _check_scalars("time", time)
    return np.asarray(velocity, np.float64)[:, None] * time
