"""Hierarchies of boxes and the exact hits of rays, for checks: what a student's are compared with.

Everything is in double precision, and slow where nobody waits for it.
"""

from typing import Any

import numpy as np

from course.school.grading.checks.check import Array, Failure

Vectors = tuple[Array, Array, Array]
"""Corners p0, p1, p2 of triangles, (3, T) each."""

Hierarchy = tuple[Array, Array, Array, Array, Array]
"""lo (3, M), hi (3, M), first (M,), count (M,), order (T,), as the module's ``build`` describes them."""


def walkable(value: Any, boxes: int) -> tuple[Hierarchy, list[Array]]:
    """A student's hierarchy, numbers of nodes and boxes as integers, and the nodes of each level.

    Raises Failure: there are more nodes than so many boxes need, or the walk from the root leaves the arrays, comes to
    a node twice, or misses one.
    """
    lo, hi, *rest = value
    first, count, order = (array.astype(np.int64) for array in rest)
    # The walk takes a time that grows with their square.
    if first.size > 2 * boxes - 1:
        raise Failure(f"at most {2 * boxes - 1} nodes for {boxes} boxes", f"{first.size}")
    visits = np.zeros(first.size, np.int64)
    levels, level = [], np.zeros(min(first.size, 1), np.int64)
    while level.size:
        visits += np.bincount(level, minlength=first.size)
        if (visits > 1).any():
            raise Failure(
                "every node but the root to be the child of one node",
                f"node {int(np.argmax(visits))} comes twice",
                hint="An inner node's children are first and first + 1.",
            )
        levels.append(level)
        leaf = count[level] != 0
        left, ends = first[level[~leaf]], (first + count)[level[leaf]]
        least = min(count[level].min(), first[level].min())
        if least < 0 or (ends > order.size).any() or (left + 1 >= first.size).any():
            raise Failure(
                "first and count within the arrays",
                f"first up to {first[level].max()}, count {count[level].min()} to {count[level].max()}",
                f"{first.size} nodes, {order.size} boxes",
            )
        level = np.concatenate((left, left + 1))
    if (visits == 0).any() or not levels:
        raise Failure("every node to be below the root, node 0", "one that is not")
    return (lo, hi, first, count, order), levels


def around(hierarchy: Hierarchy, levels: list[Array], lo: Array, hi: Array) -> tuple[Array, Array]:
    """The smallest box around all that is below each node, from the leaves upwards."""
    _, _, first, count, order = hierarchy
    low, high = (np.full((3, first.size), sign * np.inf) for sign in (1, -1))
    for k in np.concatenate(levels[::-1]):
        if count[k] > 0:
            below = order[first[k] : first[k] + count[k]].clip(0, lo.shape[1] - 1)
            low[:, k], high[:, k] = lo[:, below].min(axis=1), hi[:, below].max(axis=1)
        else:
            both = slice(first[k], first[k] + 2)
            low[:, k], high[:, k] = low[:, both].min(axis=1), high[:, both].max(axis=1)
    return low, high


def _area(lo: Array, hi: Array) -> Array:
    x, y, z = (hi - lo).astype(np.float64)
    return np.asarray(2 * (x * y + y * z + z * x))


def cost(hierarchy: Hierarchy, root: tuple[Array, Array] | None = None) -> float:
    """Mean number of tests of a random line through the root that meets boxes by their surface.

    ``root``: its box, lo and hi (3, 1), where the hierarchy's own isn't believed
    """
    lo, hi, _, count, _ = hierarchy
    share = _area(lo, hi) / _area(*(root or (lo, hi)))[0]
    return float((share * (1 + count)).sum())


def balanced(lo: Array, hi: Array, levels: int) -> Hierarchy:
    """Halves along the longest axis, ``levels`` times; as many boxes as make all leaves alike."""
    middle = lo / 2 + hi / 2
    order = np.arange(lo.shape[1])[None]
    parts = []
    for level in range(levels + 1):
        k = np.arange(1 << level)
        last = level == levels
        parts.append(
            (
                lo[:, order].min(axis=2),
                hi[:, order].max(axis=2),
                k * order.shape[1] if last else (2 << level) - 1 + 2 * k,
                np.full(k.size, order.shape[1] if last else 0),
            )
        )
        if not last:
            axis = np.ptp(middle[:, order], axis=2).argmax(axis=0)
            ranks = np.argsort(middle[axis[:, None], order], axis=1)
            order = np.take_along_axis(order, ranks, 1).reshape(2 << level, -1)
    boxes = [np.concatenate(arrays, axis=-1) for arrays in zip(*parts, strict=True)]
    return boxes[0], boxes[1], boxes[2], boxes[3], order.ravel()


def chain(lo: Array, hi: Array, order: Array) -> Hierarchy:
    """One box after the other is split off, as deep as there are boxes: the first child is a leaf."""
    count = order.size
    rest = [
        np.array([side(c[:, order[k:]], axis=1) for k in range(count)]).T
        for side, c in ((np.min, lo), (np.max, hi))
    ]
    # Node 0 has all; then come, for each k, the leaf of box k and the node of what follows it.
    lows, highs = (
        np.concatenate(
            (tail[:, :1], np.stack((c[:, order[:-1]], tail[:, 1:]), axis=2).reshape(3, -1)), axis=1
        )
        for tail, c in zip(rest, (lo, hi), strict=True)
    )
    inner = np.arange(count)
    first = np.concatenate(([1], np.stack((inner[:-1], 2 * inner[1:] + 1), axis=1).ravel()))
    held = np.concatenate(([0], np.stack((np.ones(count - 1), 0 * inner[1:]), axis=1).ravel()))
    first[-1], held[-1] = count - 1, 1
    return lows, highs, first.astype(np.int64), held.astype(np.int64), order


def lopsided(rng: np.random.Generator, lo: Array, hi: Array) -> Hierarchy:
    """A hierarchy as bad as they come: unsorted, deep here and shallow there, nodes in any order."""
    order = rng.permutation(lo.shape[1])
    runs, waiting = [(0, order.size)], [0]
    first, count = {}, {}
    while waiting:
        k = waiting.pop(int(rng.integers(len(waiting))))
        begin, end = runs[k]
        if end - begin <= 3:
            first[k], count[k] = begin, end - begin
            continue
        cut = begin + 1 + int(rng.integers(end - begin - 1)) if rng.random() < 0.5 else begin + 1
        first[k], count[k] = len(runs), 0
        waiting += [len(runs), len(runs) + 1]
        runs += [(begin, cut), (cut, end)]
    boxes = [
        np.stack([side(c[:, order[a:b]], axis=1) for a, b in runs], axis=1)
        for side, c in ((np.min, lo), (np.max, hi))
    ]
    numbers = (np.array([column[k] for k in range(len(runs))]) for column in (first, count))
    return boxes[0], boxes[1], *numbers, order  # type: ignore[return-value]


def spans(lo: Array, hi: Array, o: Array, d: Array) -> tuple[Array, Array]:
    """Where lines enter boxes and where they leave them, the coordinates being the first axis of each."""
    parallel = d == 0
    always = np.where((lo <= o) & (o <= hi), np.inf, -np.inf)
    with np.errstate(divide="ignore", invalid="ignore"):
        ends = (lo - o) / d, (hi - o) / d
        near, far = np.minimum(*ends), np.maximum(*ends)
    near, far = np.where(parallel, -always, near), np.where(parallel, always, far)
    return near.max(axis=0), far.min(axis=0)


def boxes_around(p: Vectors) -> tuple[Array, Array]:
    """The smallest box of each triangle, lo and hi (3, T)."""
    return np.min(p, axis=0), np.max(p, axis=0)


def one_leaf(p: Vectors) -> Hierarchy:
    """All triangles in the root."""
    lo, hi = boxes_around(p)
    box = lo.min(axis=1, keepdims=True), hi.max(axis=1, keepdims=True)
    return *box, np.zeros(1, int), np.array([lo.shape[1]]), np.arange(lo.shape[1])


def exact_hit(p: Any, o: Array, d: Array) -> tuple[Array, Array, Array]:
    """Where lines meet the planes of triangles: t, the least barycentric coordinate, and the cosine."""
    p0, p1, p2, o, d = (np.asarray(v, np.float64) for v in (*p, o, d))
    normal = np.cross(p1 - p0, p2 - p0, axis=0)
    square = (normal * normal).sum(axis=0)
    facing = (d * normal).sum(axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        t = ((p0 - o) * normal).sum(axis=0) / facing
        x = o + t * d
        weights = [
            (np.cross(b - a, x - a, axis=0) * normal).sum(axis=0) / square
            for a, b in ((p1, p2), (p2, p0), (p0, p1))
        ]
        cosine = np.abs(facing) / np.sqrt(square * (d * d).sum(axis=0))
    least = np.min(weights, axis=0)
    known = np.isfinite(t) & np.isfinite(least)
    return np.where(known, t, np.inf), np.where(known, least, -np.inf), np.nan_to_num(cosine)


def nearest_triangle(p: Vectors, o: Array, d: Array) -> Array:
    """The nearest triangle of each ray by testing all; -1 for none."""
    t, least, _ = exact_hit([c[:, :, None] for c in p], o[:, None], d[:, None])
    t = np.where((least >= 0) & (t > 0), t, np.inf)
    return np.where(np.isfinite(t.min(axis=0)), t.argmin(axis=0), -1)
