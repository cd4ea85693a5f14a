"""A ray a row, not a column."""

import numpy as np

FUNCTION = "displacement"
CAUGHT_BY = "contract"
MISTAKE = None


def displacement(velocity, time):
    """How far an object has gone."""
    _check_single(velocity=velocity)
    _check_scalars("time", time)
    return np.asarray(velocity, time.dtype) * time[:, None]
