"""Triangles of a lamp that lie where another one lies: their light would count once for each."""

from itertools import permutations

import numpy as np

from course.engine.core.types import Floats32, Floats64, Mask
from course.engine.core.vectors import cross, dot

CELL, CLOSE = 2.0**-16, 2.0**-20
"""Of larger lamps, triangles are compared whose middles share a cell of this size, and coincide where corners are that
near to each other: parts of the largest coordinate. Corners in another order differ by their rounding, 2^-23 of it."""

FEW = 256
"""Largest number of triangles that are compared each with each, for which it takes 20 ms: then one that others cover
together is found, too, such as half of a square that stands twice and is cut along the other diagonal."""

PLACES = np.array([*permutations((0.57, 0.29, 0.14))])
"""Barycentrics of points in a triangle; where all of them lie in others, these cover it."""


def repeated(planes: Floats32, edges: Floats32) -> Mask:
    """(T,) true for all triangles that others cover which are as large or larger, whichever side they face.

    ``planes``, ``edges``: (T, 8), see ``course.engine.core.triangles.Triangles``
    """
    p0 = planes[:, :3].astype(np.float64)
    p = np.stack((p0, p0 + edges[:, :3], p0 + edges[:, 3:6]), axis=1)
    return _covered(p) if len(p) <= FEW else _coincident(p)


def _covered(p: Floats64) -> Mask:
    e1, e2 = p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]
    normal = cross(e1.T, e2.T).T
    squared = np.maximum(dot(normal.T, normal.T), 1e-300)
    # (T points of each, T): of each point in each triangle the barycentrics, and the height above its plane.
    way = np.einsum("sk,tkx->tsx", PLACES, p)[:, :, None] - p[:, 0]
    u = np.einsum("tsjx,jx->tsj", way, cross(e2.T, normal.T).T) / squared
    v = -np.einsum("tsjx,jx->tsj", way, cross(e1.T, normal.T).T) / squared
    height = np.abs(np.einsum("tsjx,jx->tsj", way, normal)) / np.sqrt(squared)
    there = (height <= CLOSE * float(np.abs(p).max(initial=0))) & (np.minimum(u, v) >= 0)
    there &= u + v <= 1
    # The largest first, and of equal ones the first.
    order = np.argsort(-squared, kind="stable")
    kept = np.zeros(len(p), bool)
    for k in order.tolist():
        kept[k] = not there[k][:, kept].any(axis=1).all()
    return ~kept


def _coincident(p: Floats64) -> Mask:
    size = float(np.abs(p).max(initial=0))
    cells = np.round(p.mean(axis=1) / (CELL * size or 1)).astype(np.int64)
    # Each is within 2^16 of 0: three make one number.
    key = cells @ np.array((1, 1 << 20, 1 << 40))
    _, first, group = np.unique(key, return_index=True, return_inverse=True)
    other = first[group.ravel()]
    some = np.flatnonzero(other != np.arange(len(p)))
    between = np.linalg.norm(p[some][:, :, None] - p[other[some]][:, None], axis=3)
    found = np.zeros(len(p), bool)
    found[some] = between.min(axis=2).max(axis=1, initial=0) <= CLOSE * size
    return found
