"""Moves all rays by the way of the mean time."""

import numpy as np

FUNCTION = "to_object_space"
CAUGHT_BY = "travels-along"
MISTAKE = "seen-at-mean-time"
SAYS = "You use the mean time for all rays, which moves the object but leaves no streak; each ray has a time of its own."


def to_object_space(origins, velocity, time):
    """Origins of rays as a moving object sees them."""
    _check_batch("origins", origins, 3)
    _check_single(velocity=velocity)
    _check_scalars("time", time, np.shape(origins)[1])
    dtype = np.result_type(origins, time)
    moved = np.asarray(velocity) * (time.mean() if len(time) else 0)
    return (origins - moved[:, None]).astype(dtype)
