"""Uses the formula of an accelerated motion."""

import numpy as np

FUNCTION = "displacement"
CAUGHT_BY = "linear"
MISTAKE = "accelerated"
SAYS = "Your object gets faster with the square of the time; here the velocity is constant."


def displacement(velocity, time):
    """How far an object has gone."""
    _check_single(velocity=velocity)
    _check_scalars("time", time)
    velocity = np.asarray(velocity, time.dtype)
    return velocity[:, None] * time**2 / 2
