"""Only the way gone comes back, without the origins."""

import numpy as np

FUNCTION = "to_object_space"
CAUGHT_BY = "at-rest"
MISTAKE = "origins-lost"
SAYS = "You hand back how far the object has gone, but the ray's own origin is missing."


def to_object_space(origins, velocity, time):
    """Ray origins as the moving object sees them."""
    _check_batch("origins", origins, 3)
    _check_single(velocity=velocity)
    _check_scalars("time", time, np.shape(origins)[1])
    dtype = np.result_type(origins, time)
    return -np.asarray(velocity, dtype)[:, None] * time.astype(dtype)
