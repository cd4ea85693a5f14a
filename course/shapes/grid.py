"""Lattices of vertices: `across` cells along u, `up` cells along v, and circles that close exactly.

Vertex (i, j) of a lattice has index j (across + 1) + i, and uv (i / across, j / up). Where u goes
around, column `across` holds the very bits of column 0: it is a second vertex at the same place,
for the sake of its uv, and a ray can't pass between the two.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray


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
