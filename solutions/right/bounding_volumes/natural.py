"""A single box gets an axis more; results are views, or in Fortran's order."""

import numpy as np


def slab_test(origins, directions, lo, hi):
    """Row by row, in double precision."""
    _check_vectors("origins", origins)
    _check_vectors("directions", directions, np.shape(origins)[1])
    for name, corner in (("lo", lo), ("hi", hi)):
        _check_corner(name, corner, np.shape(origins)[1])
    dtype = np.result_type(origins, directions, *(c for c in (lo, hi) if c.ndim == 2))
    lo = lo[:, None] if lo.ndim == 1 else lo
    hi = hi[:, None] if hi.ndim == 1 else hi
    spans = np.empty((origins.shape[1], 2))
    spans[:] = -np.inf, np.inf
    for o, d, low, high in zip(origins.astype(float), directions, lo, hi, strict=True):
        slope = np.where(d == 0, 1.0, d)
        first, last = (low - o) / slope, (high - o) / slope
        inside = (low.astype(dtype) <= o) & (o <= high.astype(dtype))
        near = np.where(d == 0, np.where(inside, -np.inf, np.inf), np.minimum(first, last))
        far = np.where(d == 0, np.where(inside, np.inf, -np.inf), np.maximum(first, last))
        spans[:, 0] = np.maximum(spans[:, 0], near)
        spans[:, 1] = np.minimum(spans[:, 1], far)
    t_near, t_far = spans.astype(dtype).T
    return t_near, t_far


_built = build


def build(lo, hi, leaf_size):
    """The same in other memory: a list of results, boxes in Fortran's order, numbers of 64 bits."""
    low, high, first, count, order = _built(lo, hi, leaf_size)
    numbers = (array.astype(np.int64) for array in (first, count, order))
    return [np.asfortranarray(low), np.asfortranarray(high), *numbers]
