"""Moves the origins that it was given."""

import numpy as np

FUNCTION = "to_object_space"
CAUGHT_BY = "untouched"
MISTAKE = "writes-to-arguments"


def to_object_space(origins, velocity, time):
    """Origins of rays as a moving object sees them."""
    _check_batch("origins", origins, 3)
    _check_single(velocity=velocity)
    _check_scalars("time", time, np.shape(origins)[1])
    origins -= displacement(velocity, time).astype(origins.dtype)
    return origins
