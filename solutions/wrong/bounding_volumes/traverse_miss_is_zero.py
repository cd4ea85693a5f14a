"""A miss has t = 0."""

import numpy as np

FUNCTION = "traverse"
CAUGHT_BY = "one"
MISTAKE = "miss-is-zero"
SAYS = "A ray that meets nothing has t = 0, as if it had met something at its origin."


def traverse(hierarchy, p0, p1, p2, origins, directions):
    """One ray after the other."""
    _check_hierarchy(hierarchy)
    for name, corners in (("p0", p0), ("p1", p1), ("p2", p2)):
        _check_vectors(name, corners, np.shape(hierarchy[4])[0])
    _check_vectors("origins", origins)
    _check_vectors("directions", directions, np.shape(origins)[1])
    dtype = np.result_type(origins, directions)
    lo, hi, first, count, order = (array.T.tolist() for array in hierarchy)
    p0, p1, p2 = (p.T.astype(float) for p in (p0, p1, p2))
    starts, edges1, edges2 = (p.tolist() for p in (p0, p1 - p0, p2 - p0))
    n = origins.shape[1]
    triangle, t = np.full(n, -1, np.int32), np.full(n, np.inf, dtype)
    boxes, tests = np.zeros(n, np.int32), np.zeros(n, np.int32)
    for k in range(n):
        o, d = origins[:, k].tolist(), directions[:, k].tolist()
        a, b = _span(o, d, lo[0], hi[0])
        boxes[k] += 1
        waiting = [(a, 0)] if a <= b and b >= 0 else []
        while waiting:
            near, node = waiting.pop()
            if not (near <= t[k]):
                continue
            if count[node]:
                for at in range(first[node], first[node] + count[node]):
                    tests[k] += 1
                    det, u, v, s = _moller(
                        o, d, starts[order[at]], edges1[order[at]], edges2[order[at]]
                    )
                    if det != 0 and u >= 0 and v >= 0 and u + v <= 1 and s > 0 and s < t[k]:
                        t[k], triangle[k] = s, order[at]
                continue
            children = []
            for child in (first[node], first[node] + 1):
                boxes[k] += 1
                a, b = _span(o, d, lo[child], hi[child])
                if a <= b and b >= 0:
                    children.append((a, child))
            children.sort(reverse=True)
            waiting += children
    return triangle, np.where(triangle < 0, dtype.type(0), t), boxes, tests


def _span(o, d, lo, hi):
    near, far = -np.inf, np.inf
    for x, slope, low, high in zip(o, d, lo, hi, strict=True):
        if slope == 0:
            if not low <= x <= high:
                return np.inf, -np.inf
            continue
        a, b = (low - x) / slope, (high - x) / slope
        near, far = max(near, min(a, b)), min(far, max(a, b))
    return near, far * (1 + 1e-12)


def _moller(o, d, p, e, f):
    x = d[1] * f[2] - d[2] * f[1], d[2] * f[0] - d[0] * f[2], d[0] * f[1] - d[1] * f[0]
    det = e[0] * x[0] + e[1] * x[1] + e[2] * x[2]
    if det == 0:
        return 0, 0, 0, 0
    r = o[0] - p[0], o[1] - p[1], o[2] - p[2]
    y = r[1] * e[2] - r[2] * e[1], r[2] * e[0] - r[0] * e[2], r[0] * e[1] - r[1] * e[0]
    return (
        det,
        (r[0] * x[0] + r[1] * x[1] + r[2] * x[2]) / det,
        (d[0] * y[0] + d[1] * y[1] + d[2] * y[2]) / det,
        (f[0] * y[0] + f[1] * y[1] + f[2] * y[2]) / det,
    )
