"""Rows for rays, handed back as transposed views; work in place on copies of its own."""

import numpy as np


def shutter_times(open, close, u):  # noqa: A002
    """From the end, with what is left of u."""
    _check_scalars("u", u)
    if not -np.inf < open <= close < np.inf:
        raise ValueError("open <= close, both finite")
    times = np.repeat(u[:, None], 2, axis=1)[:, 1]
    times -= 1
    times *= u.dtype.type(close) - u.dtype.type(open)
    times += u.dtype.type(close)
    return times


def displacement(velocity, time):
    """A ray a row."""
    _check_single(velocity=velocity)
    _check_scalars("time", time)
    return (time[:, np.newaxis] * velocity.astype(time.dtype)).T


def to_object_space(origins, velocity, time):
    """A ray a row."""
    _check_batch("origins", origins, 3)
    _check_single(velocity=velocity)
    _check_scalars("time", time, np.shape(origins)[1])
    dtype = np.result_type(origins, time)
    seen = origins.T.astype(dtype)
    seen -= velocity.astype(dtype) * time.reshape(-1, 1).astype(dtype)
    return seen.T
