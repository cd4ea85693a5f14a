"""The dtype is that of the origins, whatever that of the times is."""

import numpy as np

FUNCTION = "to_object_space"
CAUGHT_BY = "contract"
MISTAKE = "other-dtype"


def to_object_space(origins, velocity, time):
    """Origins of rays as a moving object sees them."""
    _check_batch("origins", origins, 3)
    _check_single(velocity=velocity)
    _check_scalars("time", time, np.shape(origins)[1])
    return (origins - np.outer(velocity, time)).astype(origins.dtype)
