"""Rays in company, a node at a time, divided by which child they enter first; boxes along Morton's curve."""

import numpy as np


def slab_test(origins, directions, lo, hi):
    """Axis by axis, narrowing one interval."""
    _check_vectors("origins", origins)
    _check_vectors("directions", directions, np.shape(origins)[1])
    for name, corner in (("lo", lo), ("hi", hi)):
        _check_corner(name, corner, np.shape(origins)[1])
    batches = [origins, directions, *(c for c in (lo, hi) if np.ndim(c) == 2)]
    dtype = np.result_type(*batches)
    near = np.full(origins.shape[1], -np.inf, dtype)
    far = -near
    for axis in range(3):
        o, d = origins[axis].astype(dtype), directions[axis].astype(dtype)
        a, b = (np.asarray(c).astype(dtype)[axis] for c in (lo, hi))
        moving = np.flatnonzero(d)
        a, b = (np.broadcast_to(c, o.shape) for c in (a, b))
        with np.errstate(over="ignore"):
            into = np.where(d > 0, a, b)[moving] - o[moving]
            out = np.where(d > 0, b, a)[moving] - o[moving]
            near[moving] = np.maximum(near[moving], into / d[moving])
            far[moving] = np.minimum(far[moving], out / d[moving])
        beside = (d == 0) & ((o < a) | (o > b))
        near[beside], far[beside] = np.inf, -np.inf
    return near, far


def build(lo, hi, leaf_size):
    """Along a curve that fills space (Morton 1966), cut in halves; nodes by depth first."""
    _check_vectors("lo", lo)
    _check_vectors("hi", hi, np.shape(lo)[1])
    if np.shape(lo)[1] == 0:
        raise ValueError("lo must have at least one column, got none")
    if not leaf_size >= 1 or leaf_size != int(leaf_size):
        raise ValueError(f"leaf_size must be an integer >= 1, got {leaf_size}")
    dtype = np.result_type(lo, hi)
    lo, hi = lo.astype(dtype), hi.astype(dtype)
    middle = (lo.astype(float) + hi) / 2
    low = middle.min(axis=1, keepdims=True)
    size = max(float((middle.max(axis=1, keepdims=True) - low).max()), 1e-300)
    cells = ((middle - low) / size * 1023).astype(np.int64)
    code = np.zeros(lo.shape[1], np.int64)
    for bit in range(10):
        for axis in range(3):
            code |= (cells[axis] >> bit & 1) << (3 * bit + axis)
    order = np.argsort(code, kind="stable")
    code = code[order]
    first, count, boxes = [0], [0], [None]
    stack = [(0, 0, order.size)]
    while stack:
        node, a, b = stack.pop()
        boxes[node] = lo[:, order[a:b]].min(axis=1), hi[:, order[a:b]].max(axis=1)
        if b - a <= leaf_size:
            first[node], count[node] = a, b - a
            continue
        # Where the highest differing bit changes; in the middle where all are the same.
        differing = int(code[a] ^ code[b - 1])
        cut = (a + b) // 2
        if differing:
            mask = 1 << (differing.bit_length() - 1)
            cut = a + int(np.searchsorted((code[a:b] & mask) != 0, True))
        first[node] = len(boxes)
        stack += [(len(boxes), a, cut), (len(boxes) + 1, cut, b)]
        boxes += [None, None]
        first += [0, 0]
        count += [0, 0]
    corners = [np.stack(side, axis=1) for side in zip(*boxes, strict=True)]
    return *corners, np.array(first), np.array(count), order


def traverse(hierarchy, p0, p1, p2, origins, directions):
    """Rays are divided into those that enter the left child first and those that enter the right one first."""
    _check_hierarchy(hierarchy)
    for name, corners in (("p0", p0), ("p1", p1), ("p2", p2)):
        _check_vectors(name, corners, np.shape(hierarchy[4])[0])
    _check_vectors("origins", origins)
    _check_vectors("directions", directions, np.shape(origins)[1])
    lo, hi, first, count, order = hierarchy
    dtype, n = np.result_type(origins, directions), origins.shape[1]
    o, d = origins.astype(float), directions.astype(float)
    corners = [p.astype(float) for p in (p0, p1, p2)]
    triangle, t = np.full(n, -1, np.int32), np.full(n, np.inf)
    boxes, tests = np.zeros(n, np.int32), np.zeros(n, np.int32)

    def inside(node, rays):
        boxes[rays] += 1
        near, far = slab_test(
            o[:, rays], d[:, rays], lo[:, node].astype(float), hi[:, node].astype(float)
        )
        return np.where((near <= far * (1 + 1e-12)) & (far >= 0), near, np.inf)

    everyone = np.arange(n)
    near = inside(0, everyone)
    waiting = [(0, everyone, near)]
    while waiting:
        node, rays, near = waiting.pop()
        going = (near <= t[rays]) & (near < np.inf)
        rays = rays[going]
        if rays.size == 0:
            continue
        if count[node]:
            for name in order[first[node] : first[node] + count[node]]:
                tests[rays] += 1
                found = _one_by_all(o[:, rays], d[:, rays], *(p[:, name] for p in corners))
                nearer = found < t[rays]
                t[rays[nearer]], triangle[rays[nearer]] = found[nearer], name
            continue
        left, right = int(first[node]), int(first[node]) + 1
        a, b = inside(left, rays), inside(right, rays)
        early = a <= b
        # The last to be put there is the first to be taken.
        for child, t_in, who in (
            (right, b, early),
            (left, a, ~early),
            (left, a, early),
            (right, b, ~early),
        ):
            waiting.append((child, rays[who], t_in[who]))
    return triangle, t.astype(dtype), boxes, tests


def _one_by_all(o, d, p0, p1, p2):
    """By Cramer's rule."""
    e, f, s = p1 - p0, p2 - p0, o - p0[:, None]
    normal = np.cross(e, f)
    det = -(normal @ d)
    safe = np.where(det == 0, 1, det)
    across = np.cross(s, d, axis=0)
    u, v, t = (f @ across) / safe, -(e @ across) / safe, (normal @ s) / safe
    return np.where((det != 0) & (u >= 0) & (v >= 0) & (u + v <= 1) & (t > 0), t, np.inf)
