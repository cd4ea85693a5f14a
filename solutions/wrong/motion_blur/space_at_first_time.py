"""Moves all rays by the way of the first ray's time."""

import numpy as np

FUNCTION = "to_object_space"
CAUGHT_BY = "travels-along"
MISTAKE = "seen-at-first-time"
SAYS = "You use the first ray's time for all rays; each has its own."


def to_object_space(origins, velocity, time):
    """Origins of rays as a moving object sees them."""
    _check_batch("origins", origins, 3)
    _check_single(velocity=velocity)
    _check_scalars("time", time, np.shape(origins)[1])
    dtype = np.result_type(origins, time)
    if len(time) == 0:
        return origins.astype(dtype)
    return (origins - np.multiply(velocity, time[0])[:, None]).astype(dtype)
