"""All six pairs of corners, one after the other; children from their own ends."""

import numpy as np


def needs_subdivision(corners, threshold):
    """A pair that differs in any channel is enough."""
    shape = np.shape(corners)
    if len(shape) != 3 or shape[:2] != (3, 4):
        raise ValueError(f"corners must have shape (3, 4, n), got {shape}")
    if not threshold >= 0:
        raise ValueError(f"threshold must be >= 0, got {threshold}")
    result = np.zeros(shape[2], bool)
    for i in range(4):
        for j in range(i):
            result |= (np.abs(corners[:, i] - corners[:, j]) > threshold).any(axis=0)
    return result


def subdivide(x0, y0, x1, y1):
    """Beginning and half the size, the middle computed once."""
    _check_numbers("x0", x0)
    for name, numbers in (("y0", y0), ("x1", x1), ("y1", y1)):
        _check_numbers(name, numbers, np.shape(x0)[0])
    dtype = np.result_type(x0, y0, x1, y1)
    edges_x = np.stack((x0, x0 + (x1 - x0) / 2, x1)).astype(dtype)
    edges_y = np.stack((y0, y0 + (y1 - y0) / 2, y1)).astype(dtype)
    i, j = np.array((0, 1, 0, 1)), np.array((0, 0, 1, 1))
    return [edges_x[i], edges_y[j], edges_x[i + 1], edges_y[j + 1]]
