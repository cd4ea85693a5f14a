"""Times by interpolation in a table of two rows, ways by einsum, space by a matrix."""

import numpy as np


def shutter_times(open, close, u):  # noqa: A002
    """Times while the shutter is open."""
    _check_scalars("u", u)
    if not -np.inf < open <= close < np.inf:
        raise ValueError("open <= close, both finite")
    return np.interp(u, [0.0, 1.0], [float(open), float(close)]).astype(u.dtype)


def displacement(velocity, time):
    """How far an object has gone."""
    _check_single(velocity=velocity)
    _check_scalars("time", time)
    return np.einsum("a,n->an", np.asarray(velocity).astype(time.dtype), time)


def to_object_space(origins, velocity, time):
    """Origins of rays as a moving object sees them."""
    _check_batch("origins", origins, 3)
    _check_single(velocity=velocity)
    _check_scalars("time", time, np.shape(origins)[1])
    # Homogeneous coordinates: a translation of four-dimensional space-time.
    dtype = np.result_type(origins, time)
    shear = np.eye(3, 4)
    shear[:, 3] = np.negative(velocity)
    return (shear.astype(dtype) @ np.vstack((origins, time)).astype(dtype)).astype(dtype)
