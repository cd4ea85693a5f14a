"""An object that doesn't move along all axes is taken for one that stands still."""

import numpy as np

FUNCTION = "to_object_space"
CAUGHT_BY = "along-axes"
MISTAKE = None

_right = to_object_space


def to_object_space(origins, velocity, time):
    """With a mistake."""
    if np.all(velocity):
        return _right(origins, velocity, time)
    return _right(origins, np.zeros(3), time)
