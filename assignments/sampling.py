"""sampling - the warm-up: uniform points on a disk, in a ball and on a sphere, and a generator of random numbers.

There are two ways to a shape. Rejection draws points of the square or cube around it until enough of them fall inside;
it needs no formula, but no one knows how many numbers it will take. A polar warp turns each u into one point, and has
to know how area or volume grows with the radius.
"""

import numpy as np


def disk_by_rejection(n, rng):
    """Uniform points on the unit disk: points of the square [-1, 1)^2, of which those outside the disk are rejected.

    Parameters
    ----------
    n : int >= 0
    rng : numpy.random.Generator
        About 4 / pi points of the square are taken for each point of the disk, on average; some more do no harm.

    Returns
    -------
    (2, n) float32

    Raises
    ------
    ValueError
        n < 0.

    Task: sampling.disk_by_rejection. Source: von Neumann, "Various techniques used in connection with random
    digits", 1951.
    """
    _check_count(n)
    # TODO sampling.disk_by_rejection: write your solution here
    raise NotImplementedError("sampling.disk_by_rejection: not written yet")


def disk_by_polar(u):
    """Uniform points on the unit disk, one for each u.

    Parameters
    ----------
    u : (2, N) floating in [0, 1)

    Returns
    -------
    (2, N), of the dtype of u

    Raises
    ------
    ValueError
        u has another shape.

    Task: sampling.disk_by_polar.
    """
    _check_batch("u", u, 2)
    # TODO sampling.disk_by_polar: write your solution here
    raise NotImplementedError("sampling.disk_by_polar: not written yet")


def ball_by_rejection(n, rng):
    """Uniform points in the unit ball: points of the cube [-1, 1)^3, of which those outside the ball are rejected.

    Parameters
    ----------
    n : int >= 0
    rng : numpy.random.Generator
        About 6 / pi points of the cube are taken for each point of the ball, on average; some more do no harm.

    Returns
    -------
    (3, n) float32

    Raises
    ------
    ValueError
        n < 0.

    Task: sampling.ball_by_rejection. Source: as disk_by_rejection.
    """
    _check_count(n)
    # TODO sampling.ball_by_rejection: write your solution here
    raise NotImplementedError("sampling.ball_by_rejection: not written yet")


def ball_by_polar(u):
    """Uniform points in the unit ball, one for each u.

    Parameters
    ----------
    u : (3, N) floating in [0, 1)

    Returns
    -------
    (3, N), of the dtype of u

    Raises
    ------
    ValueError
        u has another shape.

    Task: sampling.ball_by_polar.
    """
    _check_batch("u", u, 3)
    # TODO sampling.ball_by_polar: write your solution here
    raise NotImplementedError("sampling.ball_by_polar: not written yet")


def sphere_by_polar(u):
    """Uniform points on the unit sphere, one for each u.

    Parameters
    ----------
    u : (2, N) floating in [0, 1)

    Returns
    -------
    (3, N) unit vectors, of the dtype of u

    Raises
    ------
    ValueError
        u has another shape.

    Task: sampling.sphere_by_polar. Source: Archimedes, "On the sphere and cylinder": the height is uniform.
    """
    _check_batch("u", u, 2)
    # TODO sampling.sphere_by_polar: write your solution here
    raise NotImplementedError("sampling.sphere_by_polar: not written yet")


def xorshift32(state):
    """The next random number of each stream: three shifts, by 13 to the left, 17 to the right and 5 to the left.

    Parameters
    ----------
    state : (N,) uint32
        One stream a pixel. Any number but 0 is a good start: 0 stays 0 for ever.

    Returns
    -------
    state : (N,) uint32
        The next state. It takes 2^32 - 1 steps, through all numbers but 0, until the first comes back.
    random : (N,) float32 in [0, 1)
        The next state / 2^32, to within 2^-24. The largest states give a number below 1, not 1 itself.

    Raises
    ------
    ValueError
        state has another shape, or is not uint32.

    Task: sampling.xorshift32. Source: Marsaglia, "Xorshift RNGs", 2003.
    """
    if np.ndim(state) != 1:
        raise ValueError(f"state must have shape (N,), got {np.shape(state)}")
    if getattr(state, "dtype", None) != np.uint32:
        raise ValueError(f"state must be uint32, got {getattr(state, 'dtype', type(state))}")
    # TODO sampling.xorshift32: write your solution here
    raise NotImplementedError("sampling.xorshift32: not written yet")


def _check_batch(name, array, rows, columns=None):
    shape = np.shape(array)
    if len(shape) != 2 or shape[0] != rows or (columns is not None and shape[1] != columns):
        expected = f"({rows}, {'N' if columns is None else columns})"
        raise ValueError(f"{name} must have shape {expected}, got {shape}")


def _check_count(n):
    if not n >= 0:
        raise ValueError(f"n must be >= 0, got {n}")
