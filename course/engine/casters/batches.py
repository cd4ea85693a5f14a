"""A hierarchy of NumPy's arrays, which the rays of a batch go down together, level by level.

Triangles are put in an order in which neighbours lie near each other: they are halved again and again along the axis on
which they lie farthest apart. Then up to LEAF of them share a box, each WIDTH boxes share a box of the level above, and
so on, so a box's number says which its parts are. A pair is a ray and a box that it enters; the pairs of one level give
those of the next. The arithmetic is that of ``cast_kernels``: a ray hits the same triangle, with the same bits.
"""

import numpy as np

from course.engine.core.accelerator import Intersections, no_hits
from course.engine.core.types import Floats32, Indices, Mask, Numbers
from course.engine.core.vectors import cross

LEAF, WIDTH = 4, 4
"""Most triangles of a leaf, and boxes of a box."""
RAYS = 8192
"""Rays that go down together; there may be a hundred pairs of each."""
LEAST = np.float32(1e-18)
"""Smallest component of a direction that is divided by."""
LESS, MORE = np.float32(1 - 2.0**-21), np.float32(1 + 2.0**-21)
"""By which the way to a box is shortened and the way out of it stretched: more than their rounding."""
EPSILON = np.float32(2.0**-23)
NEEDLE = np.float32(64)
"""By which the square of an edge is larger than that of the shortest one in a needle."""


class BatchCaster:
    """See ``course.engine.core.accelerator.Caster``; vertices (V, 3) float32 and triangles (T, 3) int32, T > 0."""

    def __init__(self, vertices: Floats32, triangles: Numbers) -> None:
        corners = vertices[triangles]
        low, high = corners.min(axis=1), corners.max(axis=1)
        levels = 0
        while LEAF * WIDTH**levels < len(triangles):
            levels += 1
        self._number = _order(low + high, 2 * levels)
        self._corners = corners[self._number]
        self._starts = _starts(len(triangles), WIDTH**levels)
        low = np.minimum.reduceat(low[self._number], self._starts[:-1])
        high = np.maximum.reduceat(high[self._number], self._starts[:-1])
        self._boxes = list[Floats32]()
        for _ in range(levels):
            # (boxes of the level above, lowest and highest corner, x, y and z, parts)
            parts = np.stack((low, high)).reshape(2, -1, WIDTH, 3)
            self._boxes.insert(0, np.ascontiguousarray(parts.transpose(1, 0, 3, 2)))
            low, high = parts[0].min(axis=1), parts[1].max(axis=1)
        self._boxes.insert(0, np.stack((low, high), axis=1)[..., None])

    def nearest(self, origin: Floats32, direction: Floats32, limit: Floats32) -> Intersections:
        """See ``Caster``."""
        n = direction.shape[1]
        found = no_hits(n)
        found.t[:] = limit
        o = np.ascontiguousarray(np.broadcast_to(origin, (3, n)).T)
        d = np.ascontiguousarray(direction.T)
        small = np.where(d >= 0, LEAST, -LEAST)
        inverse: Floats32 = np.reciprocal(np.where(np.abs(d) < LEAST, small, d))
        for first in range(0, n, RAYS):
            self._nearest(slice(first, first + RAYS), o, d, inverse, found)
        return found

    def free(self, origin: Floats32, direction: Floats32, limit: Floats32 | float) -> Mask:
        """See ``Caster``."""
        limits = np.broadcast_to(np.asarray(limit, np.float32), direction.shape[1:])
        return self.nearest(origin, direction, limits).triangle < 0

    def _nearest(
        self, some: slice, o: Floats32, d: Floats32, inverse: Floats32, found: Intersections
    ) -> None:
        """Put the nearest hits of some rays, as rows (N, 3), where they belong."""
        ray = np.arange(len(d))[some]
        node = np.zeros(len(ray), np.intp)
        for boxes in self._boxes:
            pair, part = np.nonzero(_enters(boxes[node], o[ray], inverse[ray], found.t[ray]))
            ray, node = ray[pair], node[pair] * boxes.shape[-1] + part
        place = self._starts[node, None] + np.arange(LEAF)
        pair, part = np.nonzero(place < self._starts[node + 1, None])
        ray, place = ray[pair], place[pair, part]
        number = self._number[place]
        u, v, t = _meet(self._corners[place], o[ray], d[ray])
        hit = np.flatnonzero((t >= 0) & (t <= found.t[ray]))
        # The nearest hit of each ray comes first, of several at one distance that of the lowest number.
        hit = hit[np.lexsort((number[hit], t[hit], ray[hit]))]
        hit = hit[np.diff(ray[hit], prepend=-1) > 0]
        found.triangle[ray[hit]] = number[hit]
        for mine, theirs in ((found.u, u), (found.v, v), (found.t, t)):
            mine[ray[hit]] = theirs[hit]


def _starts(count: int, parts: int) -> Indices:
    """Where so many parts of as even a size as can be begin, and where the last ends, (parts + 1,)."""
    return np.arange(parts + 1) * count // parts


def _order(places: Floats32, halvings: int) -> Numbers:
    """Numbers of triangles with twice their middles (T, 3) in such an order that neighbours lie near each other."""
    order = np.arange(len(places), dtype=np.int32)
    for level in range(halvings):
        starts = _starts(len(places), 2**level)
        low = np.minimum.reduceat(places, starts[:-1])
        size = np.maximum.reduceat(places, starts[:-1]) - low
        axis = size.argmax(axis=1)
        part = np.repeat(np.arange(2**level), np.diff(starts))
        along = places[np.arange(len(places)), axis[part]].astype(np.float64)
        lowest, length = (a[np.arange(2**level), axis][part] for a in (low, size))
        # Less than 1 in a part, so one sort sorts all parts.
        key = part + (along - lowest) / np.maximum(length * np.float64(1.001), 1e-300)
        change = key.argsort(kind="stable")
        order, places = order[change], places[change]
    return order


def _enters(boxes: Floats32, o: Floats32, inverse: Floats32, limit: Floats32) -> Mask:
    """Which parts (P, k) of boxes (P, 2, 3, k) rays (P, 3) enter before their limits (P,), by slabs."""
    a, b = (boxes - o[:, None, :, None]).transpose(1, 2, 0, 3) * inverse.T[:, :, None]
    near = np.minimum(a, b).max(axis=0, initial=0) * LESS
    far = np.minimum(np.maximum(a, b).min(axis=0), limit[:, None]) * MORE
    return np.asarray(near <= far)


def _meet(corners: Floats32, o: Floats32, d: Floats32) -> tuple[Floats32, Floats32, Floats32]:
    """Barycentrics u, v and distance t (P,) of rays (P, 3) and triangles (P, 3, 3); t is -1 where they miss."""
    a, b, c = corners.transpose(1, 2, 0)
    direction = d.T
    p, q, r = a - o.T, b - o.T, c - o.T
    u, v, w = (_dot(cross(e - f, e + f), direction) for e, f in ((r, p), (p, q), (q, r)))
    total = u + v + w
    room = EPSILON * np.abs(total)
    least, most = np.minimum(np.minimum(u, v), w), np.maximum(np.maximum(u, v), w)
    e, f, g = b - a, c - a, c - b
    corner, normal = p, cross(e, f)
    one = _dot(e, e)
    needle = _dot(g, g) * NEEDLE < one
    if needle.any():
        # Products of its two long edges would drown its normal in their rounding.
        second = needle & (one < _dot(f, f))
        third = needle & ~second
        normal = np.where(second, cross(g, -e), np.where(third, cross(-f, -g), normal))
        corner = np.where(second, q, np.where(third, r, p))
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        t = _dot(corner, normal) / _dot(direction, normal)
        u, v = u / total, v / total
    inside = ((least >= -room) | (most <= room)) & (total != 0)
    return u, v, np.where(inside & (t >= 0), t, np.float32(-1))


def _dot(a: Floats32, b: Floats32) -> Floats32:
    # One sum after the other, as the compiled loops add: not fused, as NumPy's own sums of products may be.
    x, y, z = a * b
    return np.asarray(x + y + z)
