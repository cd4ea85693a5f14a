"""A ray a row, not a column."""

import numpy as np

FUNCTION = "displacement"
CAUGHT_BY = "contract"
MISTAKE = "displacement-rows"
SAYS = "A point stands in each row; the agreed shape (3, N) has one in each column."


def displacement(velocity, time):
    """How far an object has gone."""
    _check_single(velocity=velocity)
    _check_scalars("time", time)
    return np.asarray(velocity, time.dtype) * time[:, None]
