"""Tools of all shapes: lattices, circles that close exactly, and joined meshes.

A lattice has `across` cells along u, `up` cells along v.
Vertex (i, j) has index j (across + 1) + i, and uv (i / across, j / up). Where u goes around, column `across` holds the
very bits of column 0: it is a second vertex at the same place, for the sake of its uv, and a ray can't pass between
the two.
"""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from course.engine.shapes.mesh import Mesh


def lattice_triangles(across: int, up: int) -> NDArray[np.int32]:
    """Return the (2 across up, 3) triangles of a lattice, counter-clockwise in the (u, v) plane."""
    row = across + 1
    a = (np.arange(up, dtype=np.int32)[:, None] * row + np.arange(across, dtype=np.int32)).ravel()
    triangles = np.empty((a.size, 2, 3), np.int32)
    triangles[:, 0] = np.stack([a, a + 1, a + row + 1], axis=1)
    triangles[:, 1] = np.stack([a, a + row + 1, a + row], axis=1)
    return triangles.reshape(-1, 3)


def lattice_uv(across: int, up: int) -> NDArray[np.float64]:
    """Return the ((up + 1) (across + 1), 2) uv of a lattice."""
    uv = np.empty((up + 1, across + 1, 2))
    uv[..., 0] = np.arange(across + 1) / across
    uv[..., 1] = (np.arange(up + 1) / up)[:, None]
    return uv.reshape(-1, 2)


def circle(segments: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return cosine and sine (segments + 1,) of i / segments turns, the last as the first."""
    angle = np.arange(segments) * (2.0 * math.pi / segments)
    cosine, sine = np.cos(angle), np.sin(angle)
    return np.append(cosine, cosine[0]), np.append(sine, sine[0])


def normalised(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return non-zero `vectors` (V, 3) at unit length."""
    return np.asarray(vectors / np.sqrt(np.sum(vectors * vectors, axis=1, keepdims=True)))


def join(parts: Sequence[Mesh]) -> Mesh:
    """Return one mesh of all `parts` in order; no vertex is merged with another.

    Parts without uv get (0, 0) where others have some.
    Raises ValueError for no parts at all, or when only some of them have normals.
    """
    if not parts:
        raise ValueError("no meshes to join")
    if len(parts) == 1:
        return parts[0]
    first: NDArray[np.int64] = np.cumsum([0, *(len(part.vertices) for part in parts)])
    normals = [part.normals for part in parts if part.normals is not None]
    if normals and len(normals) != len(parts):
        raise ValueError("some of the meshes to join have normals, some have none")
    uv = None
    if any(part.uv is not None for part in parts):
        uv = np.concatenate(
            [np.zeros((len(p.vertices), 2)) if p.uv is None else p.uv for p in parts]
        )
    # int64 only where it is needed: it doubles the memory of the triangles.
    index = np.dtype(np.int32 if first[-1] <= np.iinfo(np.int32).max else np.int64)
    triangles: NDArray[np.integer] = np.concatenate(
        [(p.triangles + k).astype(index) for p, k in zip(parts, first[:-1], strict=True)]
    )
    return Mesh(
        vertices=np.concatenate([part.vertices for part in parts]),
        triangles=triangles,
        normals=np.concatenate(normals) if normals else None,
        uv=uv,
    )
