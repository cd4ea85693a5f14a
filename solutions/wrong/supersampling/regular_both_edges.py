"""A grid from edge to edge of the pixel."""

import numpy as np

FUNCTION = "regular"
CAUGHT_BY = "centres"
MISTAKE = "both-edges"
SAYS = "Your grid goes from one edge of the pixel to the other, so neighbouring pixels share points; the outermost points should be half a cell inside."


def regular(k, n):
    """Centres of a k x k grid."""
    _check_counts(k, n)
    x = np.linspace(0, 1, k)
    points = np.zeros((2, n, k * k), np.float32)
    for row in range(k):
        for column in range(k):
            points[0, :, row * k + column] = x[column]
            points[1, :, row * k + column] = x[row]
    return points
