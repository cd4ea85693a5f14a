"""Vertex normals for meshes that come without: means of face normals, weighted by the angle or by the area.

Triangles that share a vertex are smooth there. Where faces weigh by their angles, vertices that only lie at the same
place (the three corners of each triangle in an STL file, the two sides of a texture seam) lend each other their
normals too where these are within the crease angle, and stay a hard edge where they aren't.
"""

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from course.engine.core.vectors import cross, dot
from course.engine.formats.meshes.parts import same

CREASE_DEGREES = 40.0
"""Vertices at one place whose own normals differ by more keep them apart."""

# Work at a place grows with the square of the vertices there. The tip of a fan finer than this is
# left as it is: facets so narrow need no smoothing.
MOST_COPIES = 64

CHUNK = 16384
"""Triangles at a time, whose numbers stay in the processor's cache."""


def smooth_normals(
    vertices: NDArray[np.float64], triangles: NDArray[np.integer]
) -> NDArray[np.float64]:
    """Return unit normals (V, 3), finite for every finite mesh.

    A face counts by its angle at the vertex (Thuermer & Wuethrich, "Computing vertex normals from
    polygonal facets", 1998), so that the result doesn't depend on how a flat face is cut up.
    Where no face has an area the normal is +y; where the faces cancel out, that of one of them.

    Parameters
    ----------
    vertices : (V, 3) float64
    triangles : (T, 3) integer, indices in range
    """
    faces, weights = _faces_and_angles(vertices, triangles)
    sums = _sums(len(vertices), triangles, faces, weights)
    own = unit(sums)
    normals = unit(_lend(vertices, own, sums, math.cos(math.radians(CREASE_DEGREES))))
    return _filled(normals, own, faces, triangles)


def angle_normals(
    vertices: NDArray[np.float64], triangles: NDArray[np.integer]
) -> NDArray[np.float64]:
    """As `smooth_normals`, but vertices at one place lend each other nothing."""
    faces, weights = _faces_and_angles(vertices, triangles)
    normals = unit(_sums(len(vertices), triangles, faces, weights))
    return _filled(normals, normals, faces, triangles)


def area_normals(
    vertices: NDArray[np.float64], triangles: NDArray[np.integer]
) -> NDArray[np.float64]:
    """Return unit normals (V, 3), finite for every finite mesh: sums of cross(p1 - p0, p2 - p0), made unit.

    A face counts by its area, and only where it has the vertex itself: vertices at one place lend each other nothing.
    Where no face has an area the normal is +y; where the faces cancel out, that of one of them.

    Parameters
    ----------
    vertices : (V, 3) float64
    triangles : (T, 3) integer, indices in range
    """
    p = np.moveaxis(vertices[triangles], 0, 2)
    # In units of the longest edge, so that no product leaves float64's range.
    longest = np.abs(p[1:] - p[:1]).max(initial=0.0) or 1.0
    e1, e2 = ((p[k] - p[0]) / longest for k in (1, 2))
    crossed = np.asarray(cross(e1, e2), np.float64)
    normals = unit(_sums(len(vertices), triangles, crossed, np.ones(crossed.shape)))
    return _filled(normals, normals, _unit(crossed), triangles)


def edges_and_faces(
    vertices: NDArray[np.float64], triangles: NDArray[np.integer]
) -> Iterator[tuple[slice, NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]]:
    """Yield, of CHUNK triangles after CHUNK, which they are, their edges, and these' cross products.

    Each triangle's own unit is the largest coordinate of its edges, so that no product leaves float64's range.

    Yields
    ------
    which : of the triangles
    edges : (3, 3, n), from corner 0 to 1, 1 to 2 and 2 to 0
    faces : (3, n), cross products of the first two
    lengths : (n,), the units
    """
    for first in range(0, len(triangles), CHUNK):
        which = slice(first, first + CHUNK)
        p = np.ascontiguousarray(np.moveaxis(vertices[triangles[which]], 0, 2))
        edges = p[[1, 2, 0]] - p
        longest = np.abs(edges).max(axis=(0, 1))
        unit_length = np.where(longest > 0.0, longest, 1.0)
        edges /= unit_length
        faces = np.asarray(cross(edges[0], edges[1]), np.float64)
        yield which, edges, faces, unit_length


def _faces_and_angles(
    vertices: NDArray[np.float64], triangles: NDArray[np.integer]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return face normals (3, T), zero where there is no area, and corner angles (3, T)."""
    normals, angles = np.empty((2, 3, len(triangles)))
    for which, edges, faces, _ in edges_and_faces(vertices, triangles):
        areas = np.sqrt(dot(faces, faces))
        # At corner k the edges k and (minus) k - 1 meet; all three pairs span twice the same area.
        for corner in range(3):
            angles[corner, which] = np.arctan2(areas, -dot(edges[corner], edges[corner - 1]))
        normals[:, which] = _unit(faces)
    return normals, angles


def _sums(
    count: int,
    triangles: NDArray[np.integer],
    faces: NDArray[np.float64],
    weights: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Return for each of the vertices (count, 3) the sum of its faces (3, T) by the weights of its corners (3, T)."""
    sums = np.zeros((count, 3))
    for corner in range(3):
        vertex = np.ascontiguousarray(triangles[:, corner], np.intp)
        for axis in range(3):
            sums[:, axis] += np.bincount(
                vertex, weights=weights[corner] * faces[axis], minlength=count
            )
    return sums


def _lend(
    vertices: NDArray[np.float64],
    own: NDArray[np.float64],
    sums: NDArray[np.float64],
    least_cosine: float,
) -> NDArray[np.float64]:
    """Return the sums of all copies of a vertex that face nearly the same way."""
    _, place = same(*vertices.T)
    order = np.argsort(place, kind="stable")
    copies = np.bincount(place)
    start = np.cumsum(copies) - copies
    borrowers = np.flatnonzero((copies[place] > 1) & (copies[place] <= MOST_COPIES))
    total = sums.copy()
    total[borrowers] = 0.0
    k = 0
    # Copies add up in the same order for each of them: equal sets get equal bits.
    while borrowers.size:
        lender = order[start[place[borrowers]] + k]
        near = np.sum(own[borrowers] * own[lender], axis=1) >= least_cosine
        near |= borrowers == lender
        total[borrowers[near]] += sums[lender[near]]
        k += 1
        borrowers = borrowers[copies[place[borrowers]] > k]
    return total


def _filled(
    normals: NDArray[np.float64],
    own: NDArray[np.float64],
    faces: NDArray[np.float64],
    triangles: NDArray[np.integer],
) -> NDArray[np.float64]:
    """Return `normals` with something of unit length where they are zero; faces (3, T)."""
    if _some(normals.T).all():
        return normals
    any_face = np.zeros_like(normals)
    solid = _some(faces)
    for corner in range(3):
        any_face[triangles[solid, corner]] = faces[:, solid].T
    for choice in (own, any_face, np.array([0.0, 1.0, 0.0])):
        normals = np.where(_some(normals.T)[:, None], normals, choice)
    return normals


def _some(vectors: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Which of the vectors (3, N) aren't zero."""
    return np.asarray((vectors[0] != 0) | (vectors[1] != 0) | (vectors[2] != 0))


def unit(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return vectors (N, 3) at unit length; zero stays zero. No square leaves float64's range."""
    return np.ascontiguousarray(_unit(np.asarray(vectors).T).T)


def _unit(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    """The same of (3, N)."""
    largest = np.abs(vectors).max(axis=0)
    scaled = vectors / np.where(largest > 0.0, largest, 1.0)
    return np.asarray(scaled / np.where(largest > 0.0, np.sqrt(dot(scaled, scaled)), 1.0))
