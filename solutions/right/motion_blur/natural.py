"""The most natural form: the formulas as they stand, a single vector as a column, the dtype put right at the end."""

import numpy as np


def shutter_times(open, close, u):  # noqa: A002
    """Open, and the share u of what is between."""
    _check_scalars("u", u)
    if not -np.inf < open <= close < np.inf:
        raise ValueError("open <= close, both finite")
    return (open + (close - open) * u).astype(u.dtype)


def displacement(velocity, time):
    """Velocity times time."""
    _check_single(velocity=velocity)
    _check_scalars("time", time)
    return (velocity[:, None] * time).astype(time.dtype)


def to_object_space(origins, velocity, time):
    """Origins less the way gone."""
    _check_batch("origins", origins, 3)
    _check_single(velocity=velocity)
    _check_scalars("time", time, np.shape(origins)[1])
    return (origins - velocity[:, None] * time).astype(np.result_type(origins, time))
