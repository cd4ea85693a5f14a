"""The origins come back as they are."""

import numpy as np

FUNCTION = "to_object_space"
CAUGHT_BY = "travels-along"
MISTAKE = "not-moved"
SAYS = "You hand the origins back as they came, so the object never moves."


def to_object_space(origins, velocity, time):
    """Ray origins as the moving object sees them."""
    _check_batch("origins", origins, 3)
    _check_single(velocity=velocity)
    _check_scalars("time", time, np.shape(origins)[1])
    return origins.astype(np.result_type(origins, time))
