"""Pixel number and cell number are mixed up."""

import numpy as np

FUNCTION = "regular"
CAUGHT_BY = "centres"
MISTAKE = "regular-pixels-cells"
SAYS = "The numbers of the pixel and of the cell within it have changed places."


def regular(k, n):
    """Centres of a k x k grid."""
    _check_counts(k, n)
    centre = (np.arange(k, dtype=np.float32) + np.float32(0.5)) / np.float32(k)
    xs, ys = np.meshgrid(centre, centre)
    points = np.stack((np.tile(xs.ravel(), n), np.repeat(ys.ravel(), n)))
    return points.reshape(2, n, k * k)
