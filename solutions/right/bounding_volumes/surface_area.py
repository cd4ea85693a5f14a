"""Divides where the surfaces promise the fewest tests; leaves out the root's box; double precision."""

import numpy as np


def slab_test(origins, directions, lo, hi):
    """By the rules of infinity, with 0 / 0 on a face mended afterwards."""
    _check_vectors("origins", origins)
    _check_vectors("directions", directions, np.shape(origins)[1])
    for name, corner in (("lo", lo), ("hi", hi)):
        _check_corner(name, corner, np.shape(origins)[1])
    batches = [c for c in (lo, hi) if np.ndim(c) == 2]
    dtype = np.result_type(origins, directions, *batches)
    o, d = origins.astype(float), directions.astype(float)
    a, b = (np.asarray(c).astype(dtype).astype(float).reshape(3, -1) for c in (lo, hi))
    with np.errstate(all="ignore"):
        first, last = (a - o) / d, (b - o) / d
        first = np.where(np.isnan(first), -np.inf, first)
        last = np.where(np.isnan(last), np.inf, last)
    near, far = np.minimum(first, last), np.maximum(first, last)
    on_face = (d == 0) & ((o == a) | (o == b))
    near, far = np.where(on_face, -np.inf, near), np.where(on_face, np.inf, far)
    with np.errstate(over="ignore"):
        return near.max(axis=0).astype(dtype), far.min(axis=0).astype(dtype)


def build(lo, hi, leaf_size):
    """The surface area heuristic, by sorting along each axis; recursive."""
    _check_vectors("lo", lo)
    _check_vectors("hi", hi, np.shape(lo)[1])
    if np.shape(lo)[1] == 0:
        raise ValueError("lo must have at least one column, got none")
    if not leaf_size >= 1 or leaf_size != int(leaf_size):
        raise ValueError(f"leaf_size must be an integer >= 1, got {leaf_size}")
    dtype = np.result_type(lo, hi)
    lo, hi = lo.astype(dtype), hi.astype(dtype)
    boxes, first, count, order = [None], [0], [0], []

    def divide(node, run):
        boxes[node] = (lo[:, run].min(axis=1), hi[:, run].max(axis=1))
        if run.size <= leaf_size:
            first[node], count[node] = len(order), run.size
            order.extend(run)
            return
        best = None
        for axis in range(3):
            ranked = run[np.argsort(lo[axis, run].astype(float) + hi[axis, run], kind="stable")]
            sizes = np.arange(1, run.size)
            left = _surfaces(lo[:, ranked], hi[:, ranked])[:-1]
            right = _surfaces(lo[:, ranked[::-1]], hi[:, ranked[::-1]])[-2::-1]
            price = left * sizes + right * sizes[::-1]
            # Of equal prices the one in the middle.
            cut = np.lexsort((abs(sizes - run.size / 2), price))[0]
            if best is None or price[cut] < best[0]:
                best = price[cut], ranked[: cut + 1], ranked[cut + 1 :]
        first[node] = child = len(boxes)
        boxes.extend((None, None))
        first.extend((0, 0))
        count.extend((0, 0))
        divide(child, best[1])
        divide(child + 1, best[2])

    divide(0, np.arange(lo.shape[1]))
    corners = [np.stack([box[k] for box in boxes], axis=1) for k in (0, 1)]
    return *corners, np.array(first), np.array(count), np.array(order)


def _surfaces(lo, hi):
    low = np.minimum.accumulate(lo.astype(float), axis=1)
    x, y, z = np.maximum.accumulate(hi.astype(float), axis=1) - low
    return x * y + y * z + z * x


def traverse(hierarchy, p0, p1, p2, origins, directions):
    """A ray waits with all its nodes, sorted by where it enters them; in double precision."""
    _check_hierarchy(hierarchy)
    for name, corners in (("p0", p0), ("p1", p1), ("p2", p2)):
        _check_vectors(name, corners, np.shape(hierarchy[4])[0])
    _check_vectors("origins", origins)
    _check_vectors("directions", directions, np.shape(origins)[1])
    import heapq

    lo, hi, first, count, order = hierarchy
    low, high = lo.T.tolist(), hi.T.tolist()
    first, count = first.tolist(), count.tolist()
    corners = [p.astype(float) for p in (p0, p1, p2)]
    n = origins.shape[1]
    triangle, t = np.full(n, -1, np.int32), np.full(n, np.inf)
    boxes, tests = np.zeros(n, np.int64), np.zeros(n, np.int64)
    for k in range(n):
        o, d = origins[:, k].astype(float), directions[:, k].astype(float)
        numbers = list(zip(o.tolist(), d.tolist(), strict=True))
        heap = []
        waiting = [0]
        while True:
            for node in waiting:
                boxes[k] += 1
                near, far = 0.0, np.inf
                for (x, slope), a, b in zip(numbers, low[node], high[node], strict=True):
                    if slope:
                        a, b = (a - x) / slope, (b - x) / slope
                        near, far = max(near, min(a, b)), min(far, max(a, b))
                    elif not a <= x <= b:
                        far = -1.0
                if near <= far * (1 + 1e-12):
                    heapq.heappush(heap, (near, node))
            if not heap:
                break
            near, node = heapq.heappop(heap)
            if near > t[k]:
                break
            if count[node]:
                inside = order[first[node] : first[node] + count[node]]
                tests[k] += inside.size
                found = _planes(o, d, *(p[:, inside] for p in corners))
                if found.min() < t[k]:
                    t[k], triangle[k] = found.min(), inside[found.argmin()]
                waiting = []
            else:
                waiting = [first[node], first[node] + 1]
    return triangle, t.astype(np.result_type(origins, directions)), boxes, tests


def _planes(o, d, p0, p1, p2):
    """By the plane and the volumes of three tetrahedra."""
    a, b, c = (p - o[:, None] for p in (p0, p1, p2))
    volumes = [d @ np.cross(y, x, axis=0) for x, y in ((b, c), (c, a), (a, b))]
    normal = np.cross(p1 - p0, p2 - p0, axis=0)
    facing = d @ normal
    same = np.all([v >= 0 for v in volumes], axis=0) | np.all([v <= 0 for v in volumes], axis=0)
    with np.errstate(all="ignore"):
        t = (a * normal).sum(axis=0) / facing
    return np.where(same & (facing != 0) & (t > 0), t, np.inf)
