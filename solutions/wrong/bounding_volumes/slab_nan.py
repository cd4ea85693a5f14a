"""Divides by zero and lets NaN decide."""

import numpy as np

FUNCTION = "slab_test"
CAUGHT_BY = "parallel"
MISTAKE = "face-lost"
SAYS = "You lose lines that run in the plane of a face: there zero is divided by zero."


def slab_test(origins, directions, lo, hi):
    """Lines and boxes."""
    _check_vectors("origins", origins)
    _check_vectors("directions", directions, np.shape(origins)[1])
    for name, corner in (("lo", lo), ("hi", hi)):
        _check_corner(name, corner, np.shape(origins)[1])
    corners = [np.asarray(corner) for corner in (lo, hi)]
    dtype = np.result_type(origins, directions, *(c for c in corners if c.ndim == 2))
    a, b = (c.astype(dtype).reshape(3, -1) for c in corners)

    with np.errstate(all="ignore"):
        first, last = (a - origins) / directions, (b - origins) / directions
        near, far = np.minimum(first, last).max(axis=0), np.maximum(first, last).min(axis=0)
    lost = np.isnan(near) | np.isnan(far)
    return np.where(lost, dtype.type(np.inf), near), np.where(lost, dtype.type(-np.inf), far)
