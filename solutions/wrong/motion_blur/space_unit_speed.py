"""Normalises the velocity as if it were a direction."""

import numpy as np

FUNCTION = "to_object_space"
CAUGHT_BY = "travels-along"
MISTAKE = "seen-at-unit-speed"
SAYS = "Your object always moves at 1 m/s; the velocity's length is its speed and must stay."


def to_object_space(origins, velocity, time):
    """Origins of rays as a moving object sees them."""
    _check_batch("origins", origins, 3)
    _check_single(velocity=velocity)
    _check_scalars("time", time, np.shape(origins)[1])
    dtype = np.result_type(origins, time)
    length = np.linalg.norm(velocity)
    velocity = np.asarray(velocity / (length if length > 0 else 1), dtype)
    return origins - velocity[:, None] * time.astype(dtype)
