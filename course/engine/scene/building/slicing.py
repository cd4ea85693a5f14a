"""Long thin triangles beside small things, cut across: rays leave shorter pieces from less far above.

A triangle of length L and height H is too long if 2^-25 L^2 / H (``course.engine.core.ray_offset``) shows beside a
thing. Halving it again and again would make ever thinner pieces, since half of a right triangle is as thin as the
whole. So its edges are divided first, as finely as the width of the triangle beside each piece asks for. Then the
points on the longest edge are joined with those on the two others, in the order in which they lie along it: strips
across.

Both triangles of an edge share the points on it, to the last bit, so that no ray slips through.
"""

import numpy as np

from course.engine.core import ray_offset
from course.engine.core.types import Floats64, Indices, Mask
from course.engine.scene.building.triangles import (
    NEAR,
    TOO_LARGE,
    SharedTriangles,
    SmallThings,
    ends_of,
    largest,
    nearest_of,
    raised_offsets,
)

MOST = 50_000
"""Pieces of edges from which on none is halved any more."""


def too_thin(p: Floats64, things: SmallThings, ratio: float = TOO_LARGE) -> Mask:
    """(T,) whether triangles (T, 3 corners, 3) are to be cut across.

    ``ratio``: largest offset of rays, in OFFSETs of what lies beside them
    """
    low, high = ends_of(p)
    found = np.zeros(len(p), bool)
    # No triangle is raised by more than OFFSET MOST times its length.
    some = np.flatnonzero(3 * ray_offset.MOST * largest(high - low) > ratio * things.least)
    offset = raised_offsets(p[some]) / ray_offset.OFFSET
    close = offset > np.maximum(NEAR * nearest_of(low[some], high[some]), ratio * things.least)
    some, offset = some[close], offset[close]
    found[some] = offset > ratio * things.limit(low[some], high[some])
    return found


def sliced(vertices: Floats64, corners: Indices, things: SmallThings) -> SharedTriangles:
    """Triangles with corners (T, 3), most of them whole, and pieces of those that are too thin."""
    thin = np.flatnonzero(too_thin(vertices[corners], things))
    none = np.arange(len(corners))
    if len(thin) == 0:
        return SharedTriangles(vertices, corners, none)
    pairs = np.sort(np.stack((corners, np.roll(corners, -1, axis=1)), axis=2), axis=2)
    ends, edge = np.unique(pairs.reshape(-1, 2), axis=0, return_inverse=True)
    edge = edge.reshape(-1, 3)
    p = vertices[ends]
    length = np.linalg.norm(p[:, 1] - p[:, 0], axis=1)
    longest = edge[none, length[edge].argmax(axis=1)]
    places = _divided(vertices, corners, thin, ends, edge, things)
    divided = np.zeros(len(ends), bool)
    divided[places[0]] = True
    while True:
        # The points on other edges are joined with those on the longest one.
        behind = divided[edge].any(axis=1) & ~divided[longest]
        if not behind.any():
            break
        fresh = np.unique(longest[behind])
        divided[fresh] = True
        places = np.append(places[0], fresh), np.append(places[1], np.full(len(fresh), 0.5))
    order = np.lexsort((places[1], places[0]))
    of, share = places[0][order], places[1][order][:, None]
    first = np.searchsorted(of, np.arange(len(ends) + 1))
    vertices = np.concatenate((vertices, p[of, 0] * (1 - share) + p[of, 1] * share))
    numbers = len(vertices) - len(of) + np.arange(len(of))
    touched = divided[edge].any(axis=1)
    found, origin = [corners[~touched]], [none[~touched]]
    for k in np.flatnonzero(touched).tolist():
        start = int(length[edge[k]].argmax())
        chains = []
        for side in range(3):
            i = (start + side) % 3
            between = numbers[first[edge[k, i]] : first[edge[k, i] + 1]]
            way = 1 if corners[k, i] == ends[edge[k, i], 0] else -1
            chains.append([int(corners[k, i]), *between[::way].tolist()])
        pieces = _joined(
            vertices, [*chains[0], chains[1][0]], [*chains[1], *chains[2], chains[0][0]]
        )
        found.append(pieces)
        origin.append(np.full(len(pieces), k))
    return SharedTriangles(vertices, np.concatenate(found), np.concatenate(origin))


def _divided(
    vertices: Floats64,
    corners: Indices,
    thin: Indices,
    ends: Indices,
    edge: Indices,
    things: SmallThings,
) -> tuple[Indices, Floats64]:
    """Edges (N,) and shares of their lengths (N,) at which they are to be divided."""
    q = vertices[corners[thin]]
    lengths = np.linalg.norm(np.roll(q, -1, axis=1) - q, axis=2)
    start = lengths.argmax(axis=1)
    rows = np.arange(len(thin))
    q = q[rows[:, None], (start[:, None] + np.arange(3)) % 3]
    longest = lengths.max(axis=1)
    axis = (q[:, 1] - q[:, 0]) / longest[:, None]
    foot = ((q[:, 2] - q[:, 0]) * axis).sum(axis=1)
    height = np.linalg.norm(q[:, 2] - q[:, 0] - foot[:, None] * axis, axis=1)
    foot = np.clip(foot, 1e-9 * longest, (1 - 1e-9) * longest)

    # Pieces of edges, each once for every thin triangle beside it.
    of = np.repeat(rows, 3)
    number = edge[thin].ravel()
    low, high = np.zeros(len(of)), np.ones(len(of))
    places: list[tuple[Indices, Floats64]] = []
    while len(of) < MOST:
        a, b = (
            vertices[ends[number, 0]] * (1 - x)[:, None] + vertices[ends[number, 1]] * x[:, None]
            for x in (low, high)
        )
        along = np.stack([((x - q[of, 0]) * axis[of]).sum(axis=1) for x in (a, b)])
        apex = np.clip(foot[of], along.min(axis=0), along.max(axis=0))
        width = height[of] * np.minimum(
            apex / foot[of], (longest[of] - apex) / (longest[of] - foot[of])
        )
        size = np.linalg.norm(b - a, axis=1)
        box = np.minimum(a, b), np.maximum(a, b)
        limit = np.maximum(TOO_LARGE * things.limit(*box), NEAR * nearest_of(*box))
        halved = (size > 2 * width) & (size * size > ray_offset.LONG * width * limit)
        # Whoever asks for it: the piece is halved for all triangles of the edge.
        key = number + 1j * low
        halved = np.isin(key, key[halved])
        if not halved.any():
            break
        middle = (low[halved] + high[halved]) / 2
        places.append((number[halved], middle))
        of, number = np.tile(of[halved], 2), np.tile(number[halved], 2)
        low, high = np.append(low[halved], middle), np.append(middle, high[halved])
    if not places:
        return np.zeros(0, np.intp), np.zeros(0)
    pairs = np.unique(np.concatenate([n + 1j * x for n, x in places]))
    return pairs.real.astype(np.intp), pairs.imag


def _joined(vertices: Floats64, there: list[int], back: list[int]) -> Indices:
    """Triangles (P, 3) between the points on a triangle's longest edge and those on the way back from its end."""
    back = back[::-1]
    first = vertices[there[0]]
    axis = vertices[there[-1]] - first
    along = [[float((vertices[k] - first) @ axis) for k in way] for way in (there, back)]
    a = b = 1
    found = [(there[0], there[1], back[1])]
    while a < len(there) - 2 or b < len(back) - 2:
        # Never to the end by one way alone: its last three points lie on one line.
        ahead = b == len(back) - 2 or (a < len(there) - 2 and along[0][a + 1] < along[1][b + 1])
        if ahead:
            found.append((there[a], there[a + 1], back[b]))
            a += 1
        else:
            found.append((there[a], back[b + 1], back[b]))
            b += 1
    found.append((there[a], there[-1], back[b]))
    return np.array(found)
