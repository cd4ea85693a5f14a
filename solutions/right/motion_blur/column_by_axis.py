"""Writes each axis into an array made beforehand, in Fortran order."""

import numpy as np


def shutter_times(open, close, u):  # noqa: A002
    """Times while the shutter is open."""
    _check_scalars("u", u)
    if not -np.inf < open <= close < np.inf:
        raise ValueError("open <= close, both finite")
    times = np.full_like(u, open)
    times += u * u.dtype.type(close - open)
    return times


def displacement(velocity, time):
    """How far an object has gone."""
    _check_single(velocity=velocity)
    _check_scalars("time", time)
    gone = np.zeros((3, len(time)), time.dtype, order="F")
    for axis, speed in enumerate(velocity):
        gone[axis] = time * time.dtype.type(speed)
    return gone


def to_object_space(origins, velocity, time):
    """Origins of rays as a moving object sees them."""
    _check_batch("origins", origins, 3)
    _check_single(velocity=velocity)
    _check_scalars("time", time, np.shape(origins)[1])
    seen = np.array(origins, np.result_type(origins, time), order="F")
    for axis, speed in enumerate(velocity):
        seen[axis] -= time * seen.dtype.type(speed)
    return seen
