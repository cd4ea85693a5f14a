"""Plain Python, one cell at a time."""

import numpy as np


def needs_subdivision(corners, threshold):
    """Each cell's channels in turn."""
    shape = np.shape(corners)
    if len(shape) != 3 or shape[:2] != (3, 4):
        raise ValueError(f"corners must have shape (3, 4, n), got {shape}")
    if not threshold >= 0:
        raise ValueError(f"threshold must be >= 0, got {threshold}")
    result = np.zeros(shape[2], bool)
    for k in range(shape[2]):
        for channel in corners[:, :, k].tolist():
            if max(channel) - min(channel) > threshold:
                result[k] = True
    return result


def subdivide(x0, y0, x1, y1):
    """Each cell's four children."""
    _check_numbers("x0", x0)
    for name, numbers in (("y0", y0), ("x1", x1), ("y1", y1)):
        _check_numbers(name, numbers, np.shape(x0)[0])
    result = np.empty((4, 4, len(x0)), np.result_type(x0, y0, x1, y1))
    for k, (a, b, c, d) in enumerate(zip(x0, y0, x1, y1, strict=True)):
        x, y = (float(a) + float(c)) / 2, (float(b) + float(d)) / 2
        result[:, 0, k] = a, b, x, y
        result[:, 1, k] = x, b, c, y
        result[:, 2, k] = a, y, x, d
        result[:, 3, k] = x, y, c, d
    return tuple(result)
