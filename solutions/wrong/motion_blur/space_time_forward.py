"""Takes the time without its sign."""

import numpy as np

FUNCTION = "to_object_space"
CAUGHT_BY = "travels-along"
MISTAKE = "seen-without-sign"
SAYS = (
    "You use only how long ago or ahead a time is: before time 0 the object was on the other side."
)


def to_object_space(origins, velocity, time):
    """Origins of rays as a moving object sees them."""
    _check_batch("origins", origins, 3)
    _check_single(velocity=velocity)
    _check_scalars("time", time, np.shape(origins)[1])
    dtype = np.result_type(origins, time)
    return origins - np.asarray(velocity, dtype)[:, None] * np.abs(time.astype(dtype))
