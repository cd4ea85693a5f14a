"""Moves every ray by the way of one second."""

import numpy as np

FUNCTION = "to_object_space"
CAUGHT_BY = "own-time"
MISTAKE = "seen-at-once"
SAYS = "You move every ray by the way of one whole second, whatever its time is."


def to_object_space(origins, velocity, time):
    """Origins of rays as a moving object sees them."""
    _check_batch("origins", origins, 3)
    _check_single(velocity=velocity)
    _check_scalars("time", time, np.shape(origins)[1])
    dtype = np.result_type(origins, time)
    return origins.astype(dtype) - np.asarray(velocity, dtype)[:, None]
