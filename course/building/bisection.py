"""Triangles halved again and again, so that neighbours always share whole edges.

Newest vertex bisection: each triangle has one edge that is its next to be halved, from corner 0 to corner 1; the
middle of that edge is joined to corner 2. The children's next edges are the parent's two others. When an edge is
halved, the triangle on its other side has to be halved there as well, for which its own next edge may have to go
first. Angles never get smaller than half of what they were. (Mitchell, "Adaptive refinement for arbitrary
finite-element spaces with hierarchical bases", 1991.)
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from course.core.types import Floats64, Indices, Mask


@dataclass(frozen=True)
class Triangles:
    """Triangles over shared vertices.

    Attributes
    ----------
    vertices : (V, 3) float64
    corners : (T, 3) intp, counter-clockwise seen from the front; the edge from corner 0 to corner 1 is next
    origin : (T,) intp, the triangle that each was a part of in the beginning
    """

    vertices: Floats64
    corners: Indices
    origin: Indices

    @property
    def size(self) -> int:
        """Number of triangles."""
        return len(self.corners)

    def areas(self) -> Floats64:
        """(T,)."""
        p = self.vertices[self.corners]
        areas: Floats64 = np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1) / 2
        return areas


def undivided(vertices: Floats64, corners: Indices) -> Triangles:
    """Triangles as they come from a mesh, their longest edges next."""
    p = vertices[corners]
    edges = np.linalg.norm(np.roll(p, -1, axis=1) - p, axis=2)
    # Edges that are equally long to rounding: of two triangles of a square both take the diagonal, or neither.
    first = (edges > edges.max(axis=1, keepdims=True) * (1 - 1e-6)).argmax(axis=1)
    turned = corners[np.arange(len(corners))[:, None], (first[:, None] + np.arange(3)) % 3]
    return Triangles(vertices, turned, np.arange(len(corners)))


def bisected(triangles: Triangles, chosen: Mask) -> Triangles:
    """Halve the chosen triangles, and those that have to be halved with them.

    Parameters
    ----------
    chosen : (T,) bool
    """
    corners = triangles.corners
    pairs = np.sort(np.stack((corners, np.roll(corners, -1, axis=1)), axis=2), axis=2)
    ends, edge = np.unique(pairs.reshape(-1, 2), axis=0, return_inverse=True)
    edge = edge.reshape(-1, 3)
    halved = np.zeros(len(ends), bool)
    halved[edge[chosen, 0]] = True
    while True:
        # Who has an edge halved has its next one halved, too.
        behind = halved[edge].any(axis=1) & ~halved[edge[:, 0]]
        if not behind.any():
            break
        halved[edge[behind, 0]] = True
    middle = np.full(len(ends), -1)
    middle[halved] = len(triangles.vertices) + np.arange(int(halved.sum()))
    a, b = triangles.vertices[ends[halved]].transpose(1, 0, 2)
    vertices = np.concatenate((triangles.vertices, a / 2 + b / 2))
    parts = _halves(corners, middle[edge], triangles.origin)
    return Triangles(vertices, np.concatenate(parts[0]), np.concatenate(parts[1]))


def _halves(
    corners: Indices, middles: Indices, origin: Indices
) -> tuple[list[Indices], list[Indices]]:
    """Corners and origins of all triangles afterwards: those left whole, then halves, then halves of halves."""
    whole = middles[:, 0] < 0
    found, origins = [corners[whole]], [origin[whole]]
    corners, middles, origin = corners[~whole], middles[~whole], origin[~whole]
    (p0, p1, p2), (m01, m12, m20) = corners.T, middles.T
    # Each half's next edge is one of the parent's: from p2 to p0, and from p1 to p2.
    for start, end, inner in ((p2, p0, m20), (p1, p2, m12)):
        half = np.stack((start, end, m01), axis=1)
        again = inner >= 0
        found.append(half[~again])
        origins.append(origin[~again])
        (a, b, c), m = half[again].T, inner[again]
        found += [np.stack((c, a, m), axis=1), np.stack((b, c, m), axis=1)]
        origins += [origin[again]] * 2
    return found, origins
