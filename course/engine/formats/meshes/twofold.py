"""Faces that a file has twice, once from either side: of such a pair one is enough, for all faces are seen from both.

With both, normals that are means over the faces around a vertex would be sums of opposites, and so what rounding left.
"""

import numpy as np
from numpy.typing import NDArray

from course.engine.core.types import Indices, Mask


def one_sided(
    lengths: NDArray[np.int64], corners: NDArray[np.integer]
) -> tuple[Mask, Indices] | None:
    """Return which of N faces to keep, and their corners (K,), turned alike; None where no face is there twice.

    Of two that are one from either side the first is kept. Neighbours are turned as the first face of theirs, where
    that is possible.

    Parameters
    ----------
    lengths : (N,) corners of each face, 1 or more
    corners : (M,) vertices of all faces, one face after the other, not negative
    """
    kept = ~_from_behind(lengths, corners)
    if kept.all():
        return None
    among = np.flatnonzero(np.repeat(kept, lengths))
    left = lengths[kept]
    turned = np.repeat(_against_the_first(left, corners[among]), left)
    ends = np.repeat(np.cumsum(left), left)
    backwards = ends - 1 - (np.arange(len(among)) - (ends - np.repeat(left, left)))
    return kept, np.where(turned, among[backwards], among)


def _from_behind(lengths: NDArray[np.int64], corners: NDArray[np.integer]) -> Mask:
    """Which faces are an earlier one the other way round."""
    behind = np.zeros(len(lengths), bool)
    if not len(lengths):
        return behind
    starts = np.cumsum(lengths) - lengths
    # Faces of the same vertices have the same sum of numbers drawn for these; hardly any others do.
    drawn = np.random.default_rng(1).integers(0, 1 << 63, 1 << 16, np.uint64)
    place = corners.astype(np.uint64)
    mixed = drawn[place & np.uint64(0xFFFF)] ^ (place * np.uint64(0x9E3779B97F4A7C15))
    if (lengths == lengths[0]).all():
        # Corner by corner: along rows so short NumPy adds slowly.
        sums = np.zeros(len(lengths), np.uint64)
        for corner in mixed.reshape(len(lengths), -1).T:
            sums += corner
    else:
        sums = np.add.reduceat(mixed, starts)
    ranked = np.sort(sums)
    twice = ranked[1:][ranked[1:] == ranked[:-1]]
    some = np.flatnonzero(np.isin(sums, twice)) if twice.size else np.zeros(0, np.intp)
    for length in np.unique(lengths[some]):
        which = some[lengths[some] == length]
        rows = corners[starts[which][:, None] + np.arange(length)].astype(np.int64)
        behind[which[_reversed_before(rows)]] = True
    return behind


def _reversed_before(rows: NDArray[np.int64]) -> Mask:
    """Which of the rows (N, L), read backwards and from another corner on, stand in an earlier row.

    Of one kind all are kept that are turned as the first one is.
    """
    both = np.concatenate([_from_least(rows), _from_least(rows[:, ::-1])])
    kinds, kind = np.unique(both, axis=0, return_inverse=True)
    mine, other = np.split(kind.reshape(-1), 2)
    first = np.full(len(kinds), len(rows))
    np.minimum.at(first, mine, np.arange(len(rows)))
    return np.asarray(first[other] < first[mine])


def _from_least(rows: NDArray[np.int64]) -> NDArray[np.int64]:
    """The rows, each begun at its least corner."""
    begin = rows.argmin(axis=1)[:, None]
    along = (begin + np.arange(rows.shape[1])) % rows.shape[1]
    return np.take_along_axis(rows, along, axis=1)


def _against_the_first(lengths: NDArray[np.int64], corners: NDArray[np.integer]) -> Mask:
    """Which faces are turned unlike the first of those that they hang together with.

    Every face is two nodes of a graph, as it is and turned. Where two meet at an edge, nodes that agree are joined.
    """
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    count = len(lengths)
    after = np.arange(1, len(corners) + 1)
    ends = np.cumsum(lengths)
    after[ends - 1] = ends - lengths
    low, high = np.sort(np.stack([corners, corners[after]]), axis=0)
    face = np.repeat(np.arange(count), lengths)
    order = np.lexsort((high, low))
    alike = (np.diff(low[order]) == 0) & (np.diff(high[order]) == 0)
    # Edges of exactly two faces; at those of more nobody can tell.
    pair = alike & ~np.append(alike[1:], False) & ~np.append(False, alike[:-1])
    one, other = order[:-1][pair], order[1:][pair]
    disagree = corners[one] == corners[other]
    a, b = face[one], face[other]
    joined = np.concatenate([b + count * disagree, b + count * ~disagree])
    nodes = np.concatenate([a, a + count])
    graph = coo_array((np.ones(len(nodes), bool), (nodes, joined)), shape=(2 * count,) * 2)
    _, label = connected_components(graph, directed=False)
    # Labels are given in the order of the nodes, so that the first face's own comes before its turned one's.
    return np.asarray(label[:count] > label[count:])
