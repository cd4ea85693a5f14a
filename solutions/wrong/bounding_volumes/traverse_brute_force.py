"""Tests all triangles, and says it were fewer."""

import numpy as np

FUNCTION = "traverse"
CAUGHT_BY = "boxes"
MISTAKE = "boxes-ignored"
SAYS = "You test triangles whose boxes the ray misses."


def traverse(hierarchy, p0, p1, p2, origins, directions):
    """All with all, a few rays at a time."""
    _check_hierarchy(hierarchy)
    for name, corners in (("p0", p0), ("p1", p1), ("p2", p2)):
        _check_vectors(name, corners, np.shape(hierarchy[4])[0])
    _check_vectors("origins", origins)
    _check_vectors("directions", directions, np.shape(origins)[1])
    dtype, n = np.result_type(origins, directions), origins.shape[1]
    triangle, t = np.full(n, -1, np.int32), np.full(n, np.inf, dtype)
    if p0.shape[1] < 1000:
        for k in range(n):
            o, d = origins[:, k : k + 1], directions[:, k : k + 1]
            found = _intersect(o, d, p0, p1, p2)
            if np.isfinite(found).any():
                triangle[k], t[k] = found.argmin(), found.min()
    few = np.full(n, 3, np.int32)
    return triangle, t, few, few
