"""The first box for all rays."""

import numpy as np

FUNCTION = "slab_test"
CAUGHT_BY = "through"
MISTAKE = "first-box"
SAYS = "You test all rays with the first box."


def slab_test(origins, directions, lo, hi):
    """Lines and boxes."""
    _check_vectors("origins", origins)
    _check_vectors("directions", directions, np.shape(origins)[1])
    for name, corner in (("lo", lo), ("hi", hi)):
        _check_corner(name, corner, np.shape(origins)[1])
    corners = [np.asarray(corner) for corner in (lo, hi)]
    dtype = np.result_type(origins, directions, *(c for c in corners if c.ndim == 2))
    a, b = (c.astype(dtype).reshape(3, -1) for c in corners)
    a, b = a[:, :1], b[:, :1]
    zero = directions == 0
    d = np.where(zero, 1, directions)
    between = (a <= origins) & (origins <= b)
    infinite = np.where(between, dtype.type(np.inf), dtype.type(-np.inf))
    with np.errstate(over="ignore"):
        first, last = (a - origins) / d, (b - origins) / d

    near = np.where(zero, -infinite, np.minimum(first, last)).max(axis=0)
    return near, np.where(zero, infinite, np.maximum(first, last)).min(axis=0)
