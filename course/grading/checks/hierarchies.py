"""Hierarchies of boxes and the exact hits of rays, for checks: what a student's are compared with.

Everything is in double precision, and slow where nobody waits for it.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from course.grading.checks.check import Array

Vectors = tuple[Array, Array, Array]
"""Corners p0, p1, p2 of triangles, (3, T) each."""

Hierarchy = tuple[Array, Array, Array, Array, Array]
"""lo (3, M), hi (3, M), first (M,), count (M,), order (T,), as the module's ``build`` describes them."""


def _area(lo: Array, hi: Array) -> Array:
    x, y, z = (hi - lo).astype(np.float64)
    return np.asarray(2 * (x * y + y * z + z * x))


def cost(hierarchy: Hierarchy) -> float:
    """Mean number of tests of a random line through the root that meets boxes by their surface."""
    lo, hi, _, count, _ = hierarchy
    share = _area(lo, hi) / _area(lo, hi)[0]
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
