"""motion_blur - distributing rays over time.

A camera's shutter is open for a while, and what moves in the meantime leaves a streak. Each ray belongs to one random
moment of that while and sees the scene as it stands then; the average over a pixel's rays is the streak. An object
that moves need not be moved for that: seen from the object itself, it is the ray that starts somewhere else.
"""

import numpy as np


def shutter_times(open, close, u):  # noqa: A002 - the names of the course
    """Uniform times while the shutter is open.

    Parameters
    ----------
    open, close : float [s]
        open <= close; where they are equal, that is the time of every ray.
    u : (N,) floating in [0, 1)

    Returns
    -------
    (N,) [s] in [open, close), or close by rounding alone, of the dtype of u
        They rise with u.

    Raises
    ------
    ValueError
        u is not (N,), or open and close are not finite numbers with open <= close.

    Task: motion_blur.shutter_times. Source: Cook, Porter and Carpenter, "Distributed ray tracing", 1984.
    """
    _check_scalars("u", u)
    if not -np.inf < open <= close < np.inf:
        raise ValueError(f"open and close must be finite and open <= close, got {open} and {close}")
    ### BEGIN SOLUTION
    first, last = u.dtype.type(open), u.dtype.type(close)
    # The sum may be rounded up to close, which is not in the interval any more.
    return np.minimum(first + (last - first) * u, np.nextafter(last, first))
    ### END SOLUTION


def displacement(velocity, time):
    """How far an object has gone at each time, since time 0.

    Parameters
    ----------
    velocity : (3,) [m/s]
    time : (N,) floating [s]

    Returns
    -------
    (3, N) [m], of the dtype of time

    Raises
    ------
    ValueError
        An argument has another shape.

    Task: motion_blur.displacement.
    """
    _check_single(velocity=velocity)
    _check_scalars("time", time)
    ### BEGIN SOLUTION
    return np.asarray(velocity, time.dtype)[:, None] * time
    ### END SOLUTION


def to_object_space(origins, velocity, time):
    """Origins of rays as a moving object sees them, so that the object itself can stay where it is.

    Directions do not change under translation.

    Parameters
    ----------
    origins : (3, N) floating [m]
    velocity : (3,) [m/s]
        Of the object. With (0, 0, 0) the origins come back, to within 4 units in the last place.
    time : (N,) floating [s]
        Of each ray; at 0 the object is where the scene has put it.

    Returns
    -------
    (3, N) [m], of the dtype of origins and time, or NumPy's promotion of the two

    Raises
    ------
    ValueError
        An argument has another shape.

    Task: motion_blur.to_object_space.
    """
    _check_batch("origins", origins, 3)
    _check_single(velocity=velocity)
    _check_scalars("time", time, np.shape(origins)[1])
    ### BEGIN SOLUTION
    gone = displacement(velocity, time.astype(np.result_type(origins, time), copy=False))
    return np.subtract(origins, gone, out=gone)
    ### END SOLUTION


def _check_single(**points):
    for name, point in points.items():
        if np.shape(point) != (3,):
            raise ValueError(f"{name} must have shape (3,), got {np.shape(point)}")


def _check_batch(name, array, rows, columns=None):
    shape = np.shape(array)
    if len(shape) != 2 or shape[0] != rows or (columns is not None and shape[1] != columns):
        expected = f"({rows}, {'N' if columns is None else columns})"
        raise ValueError(f"{name} must have shape {expected}, got {shape}")


def _check_scalars(name, array, columns=None):
    shape = np.shape(array)
    if len(shape) != 1 or (columns is not None and shape[0] != columns):
        expected = "(N,)" if columns is None else f"({columns},)"
        raise ValueError(f"{name} must have shape {expected}, got {shape}")
