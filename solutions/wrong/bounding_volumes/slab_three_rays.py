"""For three rays one box is taken for a row of three."""

import numpy as np

FUNCTION = "slab_test"
CAUGHT_BY = "one_box"
MISTAKE = None


def slab_test(origins, directions, lo, hi):
    """With a mistake."""
    _check_vectors("origins", origins)
    _check_vectors("directions", directions, np.shape(origins)[1])
    for name, corner in (("lo", lo), ("hi", hi)):
        _check_corner(name, corner, np.shape(origins)[1])
    own = [np.asarray(corner) for corner in (lo, hi)]
    dtype = np.result_type(origins, directions, *(corner for corner in own if corner.ndim == 2))
    lo, hi = (
        corner.astype(dtype, copy=False)
        if len(corner) == origins.shape[1]
        else corner.astype(dtype, copy=False).reshape(3, -1)
        for corner in own
    )
    parallel, between = directions == 0, (lo <= origins) & (origins <= hi)
    slope = np.where(parallel, 1, directions)
    with np.errstate(over="ignore"):
        t_lo, t_hi = (lo - origins) / slope, (hi - origins) / slope
    always = np.where(between, dtype.type(np.inf), dtype.type(-np.inf))
    t_near = np.where(parallel, -always, np.minimum(t_lo, t_hi)).max(axis=0)
    t_far = np.where(parallel, always, np.maximum(t_lo, t_hi)).min(axis=0)
    return t_near, t_far
