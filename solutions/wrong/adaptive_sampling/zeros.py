"""Zeros and False everywhere, whatever is asked."""

import numpy as np

FUNCTION = "subdivide"
CAUGHT_BY = "order"
MISTAKE = None


def needs_subdivision(corners, threshold):
    """No cell."""
    shape = np.shape(corners)
    if len(shape) != 3 or shape[:2] != (3, 4):
        raise ValueError(f"corners must have shape (3, 4, n), got {shape}")
    if not threshold >= 0:
        raise ValueError(f"threshold must be >= 0, got {threshold}")
    return np.zeros(shape[2], bool)


def subdivide(x0, y0, x1, y1):
    """Cells without a place."""
    _check_numbers("x0", x0)
    for name, numbers in (("y0", y0), ("x1", x1), ("y1", y1)):
        _check_numbers(name, numbers, np.shape(x0)[0])
    return (np.zeros((4, len(x0)), np.result_type(x0, y0, x1, y1)),) * 4
