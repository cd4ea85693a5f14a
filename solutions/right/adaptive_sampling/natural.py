"""The shortest form of each: ptp of the corners; rows of children side by side, in Fortran's order."""

import numpy as np


def needs_subdivision(corners, threshold):
    """The spread of each channel."""
    shape = np.shape(corners)
    if len(shape) != 3 or shape[:2] != (3, 4):
        raise ValueError(f"corners must have shape (3, 4, n), got {shape}")
    if not threshold >= 0:
        raise ValueError(f"threshold must be >= 0, got {threshold}")
    return (np.ptp(corners, axis=1) > threshold).any(axis=0)


def subdivide(x0, y0, x1, y1):
    """Half the sum is the middle."""
    _check_numbers("x0", x0)
    for name, numbers in (("y0", y0), ("x1", x1), ("y1", y1)):
        _check_numbers(name, numbers, np.shape(x0)[0])
    dtype = np.result_type(x0, y0, x1, y1)
    x, y = (x0 + x1) / 2, (y0 + y1) / 2
    rows = ([x0, x, x0, x], [y0, y0, y, y], [x, x1, x, x1], [y, y, y1, y1])
    return tuple(np.asfortranarray(np.array(row, dtype)) for row in rows)
