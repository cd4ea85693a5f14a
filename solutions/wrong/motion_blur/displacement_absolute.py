"""Takes the velocity without its signs."""

import numpy as np

FUNCTION = "displacement"
CAUGHT_BY = "one-second"
MISTAKE = "speed-only"


def displacement(velocity, time):
    """How far an object has gone."""
    _check_single(velocity=velocity)
    _check_scalars("time", time)
    return np.abs(np.asarray(velocity, time.dtype))[:, None] * time
