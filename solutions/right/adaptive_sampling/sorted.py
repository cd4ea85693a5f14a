"""The corners sorted in a copy; the mean of the cell's ends; arrays in another order in memory."""

import numpy as np


def needs_subdivision(corners, threshold):
    """Largest less smallest, after sorting."""
    shape = np.shape(corners)
    if len(shape) != 3 or shape[:2] != (3, 4):
        raise ValueError(f"corners must have shape (3, 4, n), got {shape}")
    if not threshold >= 0:
        raise ValueError(f"threshold must be >= 0, got {threshold}")
    ranked = np.sort(corners, axis=1)
    return np.any(ranked[:, 3] - ranked[:, 0] > threshold, axis=0)


def subdivide(x0, y0, x1, y1):
    """Cells in rows, transposed at the end."""
    _check_numbers("x0", x0)
    for name, numbers in (("y0", y0), ("x1", x1), ("y1", y1)):
        _check_numbers(name, numbers, np.shape(x0)[0])
    cells = np.array([x0, y0, x1, y1])
    x, y = np.mean(cells[[0, 2]], axis=0), np.mean(cells[[1, 3]], axis=0)
    a, b, c, d = cells
    children = np.empty((len(x0), 4, 4), cells.dtype)
    for k, child in enumerate(((a, b, x, y), (x, b, c, y), (a, y, x, d), (x, y, c, d))):
        for number, values in enumerate(child):
            children[:, number, k] = values
    return tuple(children[:, number].T for number in range(4))
