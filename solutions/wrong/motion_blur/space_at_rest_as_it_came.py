"""Beside an object that stands still origins come back as they came, in their own dtype."""

import numpy as np

FUNCTION = "to_object_space"
CAUGHT_BY = "contract"
MISTAKE = "other-dtype"


def to_object_space(origins, velocity, time):
    """With a mistake."""
    _check_batch("origins", origins, 3)
    _check_single(velocity=velocity)
    _check_scalars("time", time, np.shape(origins)[1])
    if not np.any(velocity):
        return origins.copy()
    gone = displacement(velocity, time.astype(np.result_type(origins, time), copy=False))
    return np.subtract(origins, gone, out=gone)
