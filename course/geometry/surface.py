"""All triangles of a scene as tables of float32, a row a triangle, ready to be gathered by triangle number.

The scene has been moved and scaled to [-1, 1] before (``course.scene.frame``), in float64; float32 begins here.

Symbols: p0, p1, p2 corners; e1 = p1 - p0, e2 = p2 - p0; ng geometric normal; n0, n1, n2 normals at the corners;
u, v barycentrics of p1 and p2, w = 1 - u - v.

The bulge. A coarse mesh with smooth normals stands for a round surface that rises above its flat triangles. A shadow
ray that starts on the flat triangle near the terminator runs into the neighbouring facets, and the mesh shows black
teeth. So a shadow ray starts from where the round surface would be, higher by

    h(u, v) = 1/2 (w u k01 + w v k02 + u v k12),    k_ij = (p_j - p_i) . (n_j - n_i)

which is the height of the parabola through each edge that has the normals of both its ends: for an edge of length L
on a sphere of radius R, k = L^2 / R, and h in the middle is the sagitta L^2 / (8 R). (Hanika, "Hacking the shadow
terminator", Ray Tracing Gems II, ch. 4, moves the point to the tangent planes instead, twice as high.)
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from course.core.types import Floats32, Floats64, Indices, Materials
from course.geometry.embree import Accelerator
from course.geometry.mesh import Mesh

OFFSET = 2.0**-19
"""Rays leave a surface from a point this far above it, as a share of the largest coordinate of its triangle.

Hit points are computed from barycentrics, so their error, like that of Embree's own test, is a few units in the last
place (2^-24) of the triangle's coordinates; measured in tests/geometry/test_surface.py.
"""

SLIVER = 8.0
"""Length over height from which on a triangle's offset grows in proportion.

Embree's plane of a long thin triangle is tilted by the rounding of a cross product of nearly parallel edges: the
error in height is about 2^-24 length / height times its length.
"""

MOST = 1024.0
"""The offset never grows by more than this."""

INSET = 2.0
"""Rays leave from at least this many offsets inside the triangle's edges.

In an acute concave corner a point above one wall, next to the edge, lies behind the other wall; this far from the edge
it is still inside for dihedral angles down to atan(1 / INSET) = 27 degrees.
"""


@dataclass(frozen=True)
class Part:
    """One object's mesh on its way into a surface."""

    mesh: Mesh
    material: int


@dataclass(frozen=True)
class Surface:
    """T triangles.

    Attributes
    ----------
    corner_edges : (T, 9) float32, p0, e1, e2
    normal_offset : (T, 7) float32, ng (unit), the distance by which rays leave the surface, and the barycentrics
        w, u, v below which a point counts as next to an edge
    corner_normals : (T, 9) float32, n0, n1 - n0, n2 - n0; or None when every triangle is flat
    bulge : (T, 3) float32, k01 / 2, k02 / 2, k12 / 2; or None when every triangle is flat
    material : (T,) uint16 material numbers
    accelerator : the same triangles in Embree
    """

    corner_edges: Floats32
    normal_offset: Floats32
    corner_normals: Floats32 | None
    bulge: Floats32 | None
    material: Materials
    accelerator: Accelerator

    @property
    def size(self) -> int:
        """Number of triangles."""
        return len(self.corner_edges)


def build_surface(parts: list[Part]) -> Surface:
    """Gather the triangles of all parts, whose coordinates lie in about [-1, 1].

    Triangles that have no area in float32 are left out: no ray can hit them.
    """
    corners = [_Corners(part) for part in parts]
    smooth = any(c.normals is not None for c in corners)
    vertices = _concatenate([c.vertices for c in corners], (0, 3))
    first = np.cumsum([0, *(len(c.vertices) for c in corners)])
    triangles = _concatenate(
        [c.triangles + start for c, start in zip(corners, first, strict=False)], (0, 3)
    ).astype(np.int32)
    p = vertices.astype(np.float64)[triangles]
    p0, e1, e2 = p[:, 0], p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]
    ng = np.cross(e1, e2)
    length = np.linalg.norm(ng, axis=1)
    has_area = length > 0
    ng[has_area] /= length[has_area, None]
    ng[~has_area] = (0, 1, 0)
    edges = np.stack([np.linalg.norm(e, axis=1) for e in (e2 - e1, e2, e1)], axis=1)
    longest = edges.max(axis=1, initial=0)
    ratio = np.divide(longest**2, length, out=np.ones_like(longest), where=has_area)
    offset = OFFSET * np.abs(p).max(axis=(1, 2), initial=0) * np.clip(ratio / SLIVER, 1, MOST)
    # A barycentric is the distance from its edge over the height on that edge, which is twice the area over its length.
    inset = np.minimum(
        INSET * offset[:, None] * edges / np.where(has_area, length, 1)[:, None], 1 / 3
    )
    count = np.arange(len(triangles))
    material = np.repeat(
        np.array([part.material for part in parts], np.uint16), [len(c.triangles) for c in corners]
    )
    corner_normals = bulge = None
    if smooth:
        n = _concatenate(
            [c.normals_or(ng, i) for c, i in zip(corners, _spans(corners), strict=True)], (0, 3, 3)
        )
        n0, d1, d2 = n[:, 0], n[:, 1] - n[:, 0], n[:, 2] - n[:, 0]
        k01, k02 = (e1 * d1).sum(1), (e2 * d2).sum(1)
        k12 = ((e2 - e1) * (d2 - d1)).sum(1)
        corner_normals = _table(n0, d1, d2)
        bulge = _table(np.stack((k01, k02, k12), axis=1) / 2)
    keep = count[has_area]
    accelerator = Accelerator(vertices, triangles[keep])
    return Surface(
        corner_edges=_table(p0, e1, e2)[keep],
        normal_offset=_table(ng, offset[:, None], inset)[keep],
        corner_normals=None if corner_normals is None else corner_normals[keep],
        bulge=None if bulge is None else bulge[keep],
        material=material[keep],
        accelerator=accelerator,
    )


class _Corners:
    """A part's arrays, rounded to float32 once, so that every later number agrees with Embree's vertices."""

    def __init__(self, part: Part) -> None:
        self.vertices: Floats32 = part.mesh.vertices.astype(np.float32)
        self.triangles: Indices = part.mesh.triangles.astype(np.intp)
        self.normals: Floats64 | None = part.mesh.normals

    def normals_or(self, ng: Floats64, span: slice) -> Floats64:
        """(T, 3, 3) normals at the corners, the geometric ones where the part is flat."""
        if self.normals is None:
            return np.repeat(ng[span, None, :], 3, axis=1)
        return self.normals[self.triangles]


def _spans(corners: list[_Corners]) -> list[slice]:
    ends = np.cumsum([0, *(len(c.triangles) for c in corners)])
    return [slice(int(a), int(b)) for a, b in pairwise(ends)]


def _concatenate(arrays: list[Any], empty: tuple[int, ...]) -> Any:
    return np.concatenate(arrays) if arrays else np.zeros(empty, np.float32)


def _table(*columns: Floats64) -> Floats32:
    return np.ascontiguousarray(np.concatenate(columns, axis=1), np.float32)
