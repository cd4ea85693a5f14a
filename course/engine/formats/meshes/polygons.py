"""Polygons cut into triangles, each in a plane of its own: as a fan where one fits, and else by ears.

A fan from one of its corners is right where all its triangles are turned as the polygon is, and go around the corner
less than once. Ears are cut by mapbox_earcut (Held, "FIST: Fast industrial-strength triangulation of polygons", 2001).
A polygon's plane is at right angles to Newell's normal, the sum of cross(p_i, p_i+1).
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from course.engine.core.types import Floats64, Indices, Mask
from course.engine.formats.meshes.crossings import crosses

FEW = 8
"""Corners of polygons that are tried as fans from each of them; more have one from their first corner, or none."""

ROUNDING = 1e-13
"""Areas in a polygon of size 1 that rounding gives to triangles without any."""

SAME_AREA = 1e-9
"""Share of its area to which the triangles of a polygon add up."""

FLAT = 1e-12
"""Area of a polygon of size 1 that is none."""

AT_ONCE = 1 << 20
"""Corners that are looked at in one go."""

MANY = 1000
"""Corners from which on ears are looked for where a polygon's edges are as long in all directions."""


@dataclass(frozen=True)
class Cut:
    """Triangles of polygons.

    Attributes
    ----------
    where : (T, 3) intp, numbers of corners, which are counted through all polygons; those of a polygon in its place
    doubtful : (D,) intp, the polygons that cross themselves or have no area; most of them are cut as fans
    """

    where: Indices
    doubtful: Indices


def fans(lengths: NDArray[np.int64]) -> Indices:
    """Return where the corners of triangles stand among those of polygons.

    A polygon 0 1 2 3 becomes 0 1 2 and 0 2 3, in its place.
    ``lengths``: (N,) corners of each polygon, 3 or more.
    Returns (T, 3) intp, numbers of corners, which are counted through all polygons.
    """
    triangles = lengths - 2
    first = np.repeat(np.cumsum(lengths) - lengths, triangles)
    number = np.arange(triangles.sum()) - np.repeat(np.cumsum(triangles) - triangles, triangles)
    return np.stack([first, first + number + 1, first + number + 2], axis=1).astype(np.intp)


def cut(
    lengths: NDArray[np.int64], corners: NDArray[np.integer], vertices: NDArray[np.floating]
) -> Cut:
    """Cut polygons into triangles, so many as they have corners, less two.

    Where a corner refers to no vertex, or to one that isn't finite, all is cut into fans: the caller reports it.

    Parameters
    ----------
    lengths : (N,) corners of each polygon, 3 or more
    corners : (M,) vertices of all polygons, one polygon after the other
    vertices : (V, 3)
    """
    where, doubtful = fans(lengths), [np.zeros(0, np.intp)]
    if lengths.max(initial=3) == 3:
        return Cut(where, doubtful[0])
    if corners.min() < 0 or corners.max() >= len(vertices):
        return Cut(where, doubtful[0])
    starts, first = np.cumsum(lengths) - lengths, np.cumsum(lengths - 2) - (lengths - 2)
    for which in _alike(lengths):
        length = int(lengths[which[0]])
        p = vertices[corners[starts[which][:, None] + np.arange(length)]].astype(np.float64)
        with np.errstate(all="ignore"):
            places, area = _in_plane(p)
            origin = _fans_from(places)
        finite = np.isfinite(p).all(axis=(1, 2))
        for k in np.flatnonzero((origin > 0) & finite):
            turned = (
                where[first[which[k]] :][: length - 2] - starts[which[k]] + origin[k]
            ) % length
            where[first[which[k]] :][: length - 2] = starts[which[k]] + turned
        wrong = finite & (area < FLAT)
        for k in np.flatnonzero((origin < 0) & finite & ~wrong):
            found, simple = _ears(places[k], area[k])
            if found is not None:
                where[first[which[k]] :][: length - 2] = starts[which[k]] + found
            wrong[k] = not simple
        doubtful.append(which[wrong])
    return Cut(where, np.sort(np.concatenate(doubtful)))


def _alike(lengths: NDArray[np.int64]) -> Iterator[Indices]:
    """Polygons of more than three corners, those of as many corners together, some at a time."""
    order = np.argsort(lengths, kind="stable")
    order = order[np.searchsorted(lengths[order], 4) :]
    for some in np.split(order, np.flatnonzero(np.diff(lengths[order])) + 1):
        step = max(1, AT_ONCE // int(lengths[some[0]]))
        yield from (some[k : k + step] for k in range(0, len(some), step))


def _in_plane(p: Floats64) -> tuple[Floats64, Floats64]:
    """Places (N, L, 2) of polygons (N, L, 3) in their planes, in units of their sizes, and their areas (N,)."""
    p = p - p.mean(axis=1, keepdims=True)
    size = np.abs(p).max(axis=(1, 2), keepdims=True)
    p = p / np.where(size > 0, size, 1)
    normal = np.cross(p, np.roll(p, -1, axis=1)).sum(axis=1)
    twice = np.linalg.norm(normal, axis=1)
    normal /= np.where(twice > 0, twice, 1)[:, None]
    axis = np.eye(3)[np.abs(normal).argmin(axis=1)]
    u = axis - normal * np.sum(axis * normal, axis=1, keepdims=True)
    u /= np.linalg.norm(u, axis=1, keepdims=True)
    frame = np.stack([u, np.cross(normal, u)], axis=2)
    return p @ frame, twice / 2


def _fans_from(places: Floats64) -> NDArray[np.intp]:
    """Of each polygon (N, L, 2) a corner from which a fan is right, -1 where none is found."""
    count, length, _ = places.shape
    found = np.full(count, -1, np.intp)
    for k in range(length if length <= FEW else 1):
        left = np.flatnonzero(found < 0)
        if left.size:
            found[left[_is_fan(np.roll(places[left], -k, axis=1))]] = k
    return found


def _is_fan(places: Floats64) -> Mask:
    """Whether polygons (N, L, 2) are fans from their first corners."""
    x, y = np.moveaxis(places[:, 1:] - places[:, :1], 2, 0)
    across = x[:, :-1] * y[:, 1:] - y[:, :-1] * x[:, 1:]
    along = x[:, :-1] * x[:, 1:] + y[:, :-1] * y[:, 1:]
    around = np.arctan2(np.maximum(across, 0), along).sum(axis=1)
    return np.asarray((across >= -ROUNDING).all(axis=1) & (around < 2 * np.pi))


def _ears(places: Floats64, area: float) -> tuple[Indices | None, bool]:
    """Triangles (L - 2, 3) of a polygon (L, 2), None if there are others; and whether it is simple."""
    from mapbox_earcut import triangulate_float64

    length = len(places)
    even = _evened(places) if length > MANY else places
    if crosses(even):
        return None, False
    found = triangulate_float64(np.ascontiguousarray(even), np.array([length], np.uint32)).reshape(
        -1, 3
    )
    ears = found.astype(np.intp)
    # A corner at the end of a spike is in no triangle, and has one without area instead.
    rows = np.pad(ears, ((0, max(0, length - 2 - len(ears))), (0, 0)))
    x, y = np.moveaxis(places[rows[:, 1:]] - places[rows[:, :1]], 2, 0)
    total = np.abs(x[:, 0] * y[:, 1] - y[:, 0] * x[:, 1]).sum() / 2
    if len(rows) != length - 2 or abs(total - area) > SAME_AREA * area:
        return None, False
    return rows, True


def _evened(places: Floats64) -> Floats64:
    """An affine image of a polygon (L, 2) whose edges are as long in all directions: a comb's ears are found sooner."""
    edges = np.roll(places, -1, axis=0) - places
    squares, axes = np.linalg.eigh(edges.T @ edges)
    axes[:, 0] *= np.sign(np.linalg.det(axes))
    return np.asarray(places @ axes / np.sqrt(np.maximum(squares, 1e-20 * squares[1])))
