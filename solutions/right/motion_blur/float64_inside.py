"""Computes in float64 and rounds once, at the end."""

import numpy as np


def shutter_times(open, close, u):  # noqa: A002
    """Times while the shutter is open."""
    _check_scalars("u", u)
    if not -np.inf < open <= close < np.inf:
        raise ValueError("open <= close, both finite")
    u64 = u.astype(np.float64)
    return ((1 - u64) * float(open) + u64 * float(close)).astype(u.dtype)


def displacement(velocity, time):
    """How far an object has gone."""
    _check_single(velocity=velocity)
    _check_scalars("time", time)
    gone = np.outer(np.asarray(velocity, np.float64), time.astype(np.float64))
    return gone.astype(time.dtype)


def to_object_space(origins, velocity, time):
    """Origins of rays as a moving object sees them."""
    _check_batch("origins", origins, 3)
    _check_single(velocity=velocity)
    _check_scalars("time", time, np.shape(origins)[1])
    seen = origins.astype(np.float64) - np.outer(np.asarray(velocity, np.float64), time)
    return seen.astype(np.result_type(origins, time))
