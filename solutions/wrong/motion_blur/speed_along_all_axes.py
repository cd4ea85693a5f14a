"""Uses the speed along each axis, not the velocity."""

import numpy as np

FUNCTION = "displacement"
CAUGHT_BY = "one-second"
MISTAKE = "speed-only"
SAYS = (
    "You use only how large the velocity is, and lose in which direction it points along each axis."
)


def displacement(velocity, time):
    """How far an object has gone."""
    _check_single(velocity=velocity)
    _check_scalars("time", time)
    velocity = np.asarray(velocity, time.dtype)
    speed = np.linalg.norm(velocity)
    return np.stack((speed * time, speed * time, speed * time))
