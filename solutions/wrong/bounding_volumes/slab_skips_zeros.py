"""Components of zero are no concern of its."""

import numpy as np

FUNCTION = "slab_test"
CAUGHT_BY = "parallel"
MISTAKE = "parallel-kept"
SAYS = "You take no notice of faces that a line runs along; it may be outside them for ever."


def slab_test(origins, directions, lo, hi):
    """Lines and boxes."""
    _check_vectors("origins", origins)
    _check_vectors("directions", directions, np.shape(origins)[1])
    for name, corner in (("lo", lo), ("hi", hi)):
        _check_corner(name, corner, np.shape(origins)[1])
    corners = [np.asarray(corner) for corner in (lo, hi)]
    dtype = np.result_type(origins, directions, *(c for c in corners if c.ndim == 2))
    a, b = (c.astype(dtype).reshape(3, -1) for c in corners)
    zero = directions == 0
    d = np.where(zero, 1, directions)
    between = (a <= origins) & (origins <= b)
    infinite = np.where(between, dtype.type(np.inf), dtype.type(-np.inf))
    with np.errstate(over="ignore"):
        first, last = (a - origins) / d, (b - origins) / d

    endless = dtype.type(np.inf)
    near = np.where(zero, -endless, np.minimum(first, last)).max(axis=0)
    return near, np.where(zero, endless, np.maximum(first, last)).min(axis=0)
