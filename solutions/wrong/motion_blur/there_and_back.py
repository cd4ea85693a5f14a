"""Goes there and back, and so loses the last digits of an origin at rest."""

import numpy as np

FUNCTION = "to_object_space"
CAUGHT_BY = "at-rest"
MISTAKE = None


def to_object_space(origins, velocity, time):
    """Origins of rays as a moving object sees them."""
    _check_batch("origins", origins, 3)
    _check_single(velocity=velocity)
    _check_scalars("time", time, np.shape(origins)[1])
    dtype = np.result_type(origins, time)
    pivot = dtype.type(10)
    return (origins + pivot) - displacement(velocity, time.astype(dtype)) - pivot
