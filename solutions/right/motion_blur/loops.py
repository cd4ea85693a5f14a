"""One ray at a time, in plain Python numbers."""

import numpy as np


def shutter_times(open, close, u):  # noqa: A002
    """Times while the shutter is open."""
    _check_scalars("u", u)
    if not -np.inf < open <= close < np.inf:
        raise ValueError("open <= close, both finite")
    times = np.empty(u.shape, u.dtype)
    for ray in range(len(u)):
        times[ray] = float(open) + (float(close) - float(open)) * float(u[ray])
    return times


def displacement(velocity, time):
    """How far an object has gone."""
    _check_single(velocity=velocity)
    _check_scalars("time", time)
    gone = np.empty((3, len(time)), time.dtype)
    for ray in range(len(time)):
        for axis in range(3):
            gone[axis, ray] = float(velocity[axis]) * float(time[ray])
    return gone


def to_object_space(origins, velocity, time):
    """Origins of rays as a moving object sees them."""
    _check_batch("origins", origins, 3)
    _check_single(velocity=velocity)
    _check_scalars("time", time, np.shape(origins)[1])
    seen = np.empty(origins.shape, np.promote_types(origins.dtype, time.dtype))
    for ray in range(len(time)):
        for axis in range(3):
            seen[axis, ray] = float(origins[axis, ray]) - float(velocity[axis]) * float(time[ray])
    return seen
