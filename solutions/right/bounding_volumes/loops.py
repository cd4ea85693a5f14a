"""Plain Python, one ray and one node at a time."""

import numpy as np


def slab_test(origins, directions, lo, hi):
    """Lines and boxes one by one."""
    _check_vectors("origins", origins)
    _check_vectors("directions", directions, np.shape(origins)[1])
    for name, corner in (("lo", lo), ("hi", hi)):
        _check_corner(name, corner, np.shape(origins)[1])
    corners = [np.asarray(corner) for corner in (lo, hi)]
    dtype = np.result_type(origins, directions, *(c for c in corners if c.ndim == 2))
    n = origins.shape[1]
    lo, hi = (np.broadcast_to(c.astype(dtype).reshape(3, -1), (3, n)) for c in corners)
    result = np.empty((2, n), dtype)
    for k in range(n):
        box = [c[:, k].tolist() for c in (lo, hi)]
        result[:, k] = _clip(origins[:, k].tolist(), directions[:, k].tolist(), *box)
    return result[0], result[1]


def _clip(o, d, lo, hi):
    near, far = -np.inf, np.inf
    for x, slope, low, high in zip(o, d, lo, hi, strict=True):
        if slope == 0:
            if not low <= x <= high:
                return np.inf, -np.inf
            continue
        a, b = (low - x) / slope, (high - x) / slope
        near, far = max(near, min(a, b)), min(far, max(a, b))
    return near, far


def build(lo, hi, leaf_size):
    """Halves, and halves of these."""
    _check_vectors("lo", lo)
    _check_vectors("hi", hi, np.shape(lo)[1])
    if np.shape(lo)[1] == 0:
        raise ValueError("lo must have at least one column, got none")
    if not leaf_size >= 1 or leaf_size != int(leaf_size):
        raise ValueError(f"leaf_size must be an integer >= 1, got {leaf_size}")
    dtype = np.result_type(lo, hi)
    lo, hi = lo.astype(dtype), hi.astype(dtype)
    middle = lo / 2 + hi / 2
    low, high = lo, hi
    boxes, first, count, order = [None], [0], [0], []
    waiting = [(0, np.arange(lo.shape[1]))]
    while waiting:
        node, run = waiting.pop()
        boxes[node] = low[:, run].min(axis=1), high[:, run].max(axis=1)
        if run.size <= leaf_size:
            first[node], count[node] = len(order), run.size
            order.extend(run)
        else:
            key = middle[np.ptp(middle[:, run], axis=1).argmax()]
            run = run[np.argsort(key[run])]
            first[node] = len(boxes)
            for half in (run[: run.size // 2], run[run.size // 2 :]):
                waiting.append((len(boxes), half))
                boxes.append(None)
                first.append(0)
                count.append(0)
    corners = np.array(boxes).transpose(1, 2, 0)
    return corners[0].copy(), corners[1].copy(), np.array(first), np.array(count), np.array(order)


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
    return triangle, t, boxes, tests


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
