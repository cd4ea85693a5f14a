"""All triangles of a scene as tables of float32, a row a triangle, ready to be gathered by triangle number.

The scene has been moved and scaled to [-1, 1] before (``course.scene.frame``), in float64; float32 begins here.

Symbols: p0, p1, p2 corners; e1 = p1 - p0, e2 = p2 - p0; ng geometric normal; n0, n1, n2 normals at the corners;
u, v barycentrics of p1 and p2, w = 1 - u - v.

The normals of a mesh that has been stretched unevenly differ in length. Interpolated as they are, and only then made
unit vectors, they are what the normals of the mesh before would be if they were interpolated first and transformed
then: those of an ellipsoid if it was a sphere. Their lengths count nowhere else.

The bulge. A coarse mesh with smooth normals stands for a round surface that rises above its flat triangles. A shadow
ray that starts on the flat triangle near the terminator runs into the neighbouring facets, and the mesh shows black
teeth. So a shadow ray starts from where the round surface would be, higher by

    h(u, v) = 1/2 (w u k01 + w v k02 + u v k12),    k_ij = (p_j - p_i) . (n_j - n_i)

which is the height of the parabola through each edge that has the normals of both its ends: for an edge of length L
on a sphere of radius R, k = L^2 / R, and h in the middle is the sagitta L^2 / (8 R). (Hanika, "Hacking the shadow
terminator", Ray Tracing Gems II, ch. 4, moves the point to the tangent planes instead, twice as high.)
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from course.core.types import Floats, Floats32, Floats64, Mask, Materials, Numbers
from course.core.vectors import cross, dot
from course.geometry.accelerators import AnyAccelerator
from course.geometry.behind import Behind, FrontAccelerator, SeenThrough
from course.geometry.convex import Extent
from course.geometry.embree import Accelerator
from course.geometry.hierarchy import HierarchyAccelerator, HierarchyFunctions
from course.geometry.mesh import Mesh
from course.geometry.motion_functions import MotionFunctions
from course.geometry.moving import Mover, MovingAccelerator
from course.geometry.painting import Paint, Painting, make_painting

OFFSET = 2.0**-19
"""Rays leave a surface from a point this far above it, as a share of the largest coordinate of its triangle.

Hit points are computed from barycentrics, so their error, like that of Embree's own test, is a few units in the last
place (2^-24) of the triangle's coordinates; measured in tests/geometry/test_surface.py.
"""

SLIVER = 8.0
"""Length over height beyond which a triangle is long and thin.

Embree's plane of such a triangle is tilted by the rounding of a cross product of nearly parallel edges, which it takes
from the ray's origin: the error in height is about 2^-24 length / height times its length.
"""

TILT = 0.5
"""Its offset is at least OFFSET times its length times this for each unit of length / height beyond SLIVER."""

MOST = 1024.0
"""The offset never exceeds OFFSET times this many lengths of the triangle."""

INSET = 2.0
"""Rays leave from at least this many offsets inside the triangle's edges.

In an acute concave corner a point above one wall, next to the edge, lies behind the other wall; this far from the edge
it is still inside for dihedral angles down to atan(1 / INSET) = 27 degrees.
"""


UNIT = 1e-9
"""Normals count as unit vectors if their lengths are within this of 1."""

FLAT = 1e-5
"""A triangle is flat if it has the same normal at all corners, within this of its own."""

FAINTEST = 2.0**-24
"""Normals are at least this long beside the longest of their triangle: float32 has no more digits for what they add to
it, but the point at their own corner has a direction."""


@dataclass(frozen=True)
class Part:
    """One object's mesh on its way into a surface.

    ``convex`` is as ``course.geometry.convex`` means it, ``behind`` as ``course.geometry.behind``.
    """

    mesh: Mesh
    material: int
    velocity: tuple[float, float, float] = (0.0, 0.0, 0.0)
    paint: Paint | None = None
    convex: bool = False
    behind: Behind = "turned"


@dataclass(frozen=True)
class Surface:
    """T triangles.

    Attributes
    ----------
    planes : (T, 8) float32, the corner p0, ng (unit), the distance by which rays leave the surface, and 1 where ng is
        the shading normal, too, 0 where that is interpolated
    edges : (T, 8) float32, e1 = p1 - p0, e2 = p2 - p0, the largest inset, and nothing: NumPy takes rows of 32 bytes in
        half the time that rows of 24 or 36 take
    inset : (T, 3) float32, the barycentrics w, u, v below which a point counts as next to an edge
    corner_normals : (T, 9) float32, n0, n1 - n0, n2 - n0, the longest normal of a triangle of length 1; or None when
        every triangle is flat
    bulge : (T, 3) float32, k01 / 2, k02 / 2, k12 / 2; or None when every triangle is flat, or is to count as flat
        for shadow rays
    bend : sine of the largest angle between a triangle and a normal at its corners, 0 when every triangle is flat
    material : (T,) uint16 material numbers
    accelerator : the same triangles in Embree, or in a hierarchy
    painting : the textures, None where there are none
    bent : (M,) bool, of which materials shading normals that look away from the viewer are bent until they no longer
        do; None for all
    kept : (T,) bool, whose normals camera rays see as they are from behind; None for none
    through : what camera rays meet where they see through backs; None where they meet what all rays do
    """

    planes: Floats32
    edges: Floats32
    inset: Floats32
    corner_normals: Floats32 | None
    bulge: Floats32 | None
    bend: float
    material: Materials
    accelerator: AnyAccelerator
    painting: Painting | None = None
    bent: Mask | None = None
    kept: Mask | None = None
    through: SeenThrough | None = None

    @property
    def seen(self) -> AnyAccelerator | SeenThrough:
        """What camera rays meet."""
        return self.accelerator if self.through is None else self.through

    @property
    def size(self) -> int:
        """Number of triangles."""
        return len(self.planes)


def build_surface(
    parts: list[Part],
    motion: MotionFunctions | None = None,
    bulges: bool = True,
    hierarchy: HierarchyFunctions | None = None,
    bent: Mask | None = None,
    least_offset: float = 0.0,
    eye: Floats64 | None = None,
) -> Surface:
    """Gather the triangles of all parts, whose coordinates lie in about [-1, 1].

    Triangles that have no area in float32 are left out: no ray can hit them. ``motion`` is needed where a part has a
    velocity; parts that move alike share a hierarchy, and come after those that stand still. Without ``bulges`` shadow
    rays start from the triangles themselves. ``hierarchy`` takes the place of Embree, where nothing moves. ``bent`` as
    ``Surface`` has it. Rays leave surfaces at ``least_offset`` or farther. ``eye``
    (3,) is where all camera rays begin, None where they don't begin in one place.
    """
    still = (0.0, 0.0, 0.0)
    parts = sorted(parts, key=lambda part: (part.velocity != still, part.velocity))
    smooth = any(part.mesh.normals is not None for part in parts)
    tables = [_tables(part, smooth, least_offset) for part in parts]
    if not tables:
        tables = [_tables(Part(Mesh(np.zeros((0, 3)), np.zeros((0, 3), np.intp)), 0), smooth, 0.0)]
    groups: dict[tuple[float, float, float], list[_Tables]] = {still: []}
    for table in tables:
        groups.setdefault(table.velocity, []).append(table)
    static = groups.pop(still)
    accelerator: AnyAccelerator
    if hierarchy is not None:
        assert not groups
        accelerator = HierarchyAccelerator(*_joined(static), hierarchy)
    elif groups:
        assert motion is not None
        assert motion.to_object_space is not None
        accelerator = MovingAccelerator(
            _accelerator(static),
            tuple(_movers(groups, tables)),
            motion.to_object_space,
            motion.displacement,
        )
    else:
        extents = [Extent(len(t.vertices), len(t.triangles), t.convex) for t in static]
        hidden = np.concatenate([_hidden(table, eye) for table in static])
        arrays = *_joined(static), extents
        accelerator = FrontAccelerator(*arrays, hidden) if hidden.any() else Accelerator(*arrays)
    kept, unseen = _of_kind(tables, "kept"), _of_kind(tables, "unseen")
    planes = np.concatenate([table.planes for table in tables])
    through = None
    if unseen is not None:
        front = accelerator.front if isinstance(accelerator, FrontAccelerator) else accelerator
        through = SeenThrough(front, unseen, planes)
    return Surface(
        planes=planes,
        edges=np.concatenate([table.edges for table in tables]),
        inset=np.concatenate([table.inset for table in tables]),
        corner_normals=np.concatenate([t.corner_normals for t in tables]) if smooth else None,
        bulge=np.concatenate([t.bulge for t in tables]) if smooth and bulges else None,
        bend=max(table.bend for table in tables),
        material=np.concatenate([table.material for table in tables]),
        accelerator=accelerator,
        painting=make_painting([(len(table.triangles), table.paint) for table in tables]),
        bent=bent,
        kept=kept,
        through=through,
    )


def _of_kind(tables: list[_Tables], behind: Behind) -> Mask | None:
    """(T,) which triangles are seen like that from behind; None for none."""
    kinds = [np.full(len(table.triangles), table.behind == behind) for table in tables]
    return np.concatenate(kinds) if any(kind.any() for kind in kinds) else None


def _hidden(table: _Tables, eye: Floats64 | None) -> Mask:
    """(T,) which triangles are seen through by an eye (3,), None for an eye of which that is not known."""
    if eye is None or table.behind != "unseen":
        return np.zeros(len(table.triangles), np.bool_)
    corner, normal = table.planes[:, :3].T.astype(np.float64), table.planes[:, 3:6].T
    return np.asarray(dot(eye[:, None] - corner, normal.astype(np.float64)) <= 0)


def _accelerator(tables: list[_Tables]) -> Accelerator:
    return Accelerator(*_joined(tables))


def _joined(tables: list[_Tables]) -> tuple[Floats32, Numbers]:
    """Vertices (V, 3) and triangles (T, 3) of several parts."""
    if not tables:
        return np.zeros((0, 3), np.float32), np.zeros((0, 3), np.int32)
    first = np.cumsum([0, *(len(table.vertices) for table in tables)])[:-1]
    triangles = [table.triangles + start for table, start in zip(tables, first, strict=True)]
    vertices = np.concatenate([table.vertices for table in tables])
    return vertices, np.concatenate(triangles).astype(np.int32)


def _movers(
    groups: dict[tuple[float, float, float], list[_Tables]], tables: list[_Tables]
) -> Iterator[Mover]:
    """Movers in the order of their triangles, behind the static ones."""
    moving = sum(len(table.triangles) for group in groups.values() for table in group)
    first = sum(len(table.triangles) for table in tables) - moving
    for velocity, group in groups.items():
        last = first + sum(len(table.triangles) for table in group)
        yield Mover(np.array(velocity, np.float32), _accelerator(group), first, last)
        first = last


@dataclass(frozen=True)
class _Tables:
    """One part's share of the surface; normals and bulge are empty where no part is smooth."""

    vertices: Floats32
    triangles: Numbers
    planes: Floats32
    edges: Floats32
    inset: Floats32
    material: Materials
    corner_normals: Floats32
    bulge: Floats32
    bend: float
    velocity: tuple[float, float, float]
    paint: Paint | None
    convex: bool
    behind: Behind


def _tables(part: Part, smooth: bool, least_offset: float) -> _Tables:
    mesh = part.mesh
    # Rounded to float32 once, so that every number below agrees with Embree's vertices.
    vertices = mesh.vertices.astype(np.float32)
    p = np.ascontiguousarray(np.moveaxis(vertices.astype(np.float64)[mesh.triangles], 0, 2))
    ng = cross(p[1] - p[0], p[2] - p[0])
    has_area = np.flatnonzero(dot(ng, ng) > 0)
    triangles = mesh.triangles[has_area]
    p, ng = p[:, :, has_area], ng[:, has_area]
    e1, e2 = p[1] - p[0], p[2] - p[0]
    twice_area = np.sqrt(dot(ng, ng))
    ng /= twice_area
    lengths = np.sqrt(np.stack([dot(e, e) for e in (e2 - e1, e2, e1)]))
    longest = lengths.max(axis=0, initial=0)
    thinness = longest * longest / twice_area
    tilt = longest * np.clip(TILT * (thinness - SLIVER), 0, MOST)
    offset = OFFSET * np.maximum(np.abs(p).max(axis=(0, 1), initial=0), tilt)
    # A barycentric is the distance from its edge over the height on that edge, which is twice the area over its length.
    inset = np.minimum(INSET * offset * lengths / twice_area, 1 / 3)
    corner_normals, bulge = np.zeros((2, 0, 0), np.float32)
    bend = 0.0
    flat = np.ones(len(triangles))
    if smooth:
        n = unit = np.repeat(ng[None], 3, axis=0)
        if mesh.normals is not None:
            n, unit = _at_corners(mesh.normals, triangles)
            # The file's own normal has the more digits: rounding its vertices to float32 turns a small triangle.
            flat = (np.abs(n - ng) < FLAT).all(axis=(0, 1)) & (n == n[0]).all(axis=(0, 1))
            ng = np.where(flat, n[0], ng)
            cosine = min((float(dot(ng, corner).min(initial=1)) for corner in unit), default=1.0)
            bend = math.sqrt(max(1 - cosine * cosine, 0)) if cosine > 0 else 1.0
        corner_normals = _table(n[0], n[1] - n[0], n[2] - n[0])
        d1, d2 = unit[1] - unit[0], unit[2] - unit[0]
        bulge = _table(np.stack((dot(e1, d1), dot(e2, d2), dot(e2 - e1, d2 - d1))) / 2)
    return _Tables(
        vertices,
        triangles.astype(np.int32),
        _table(p[0], ng, np.maximum(offset, least_offset)[None], flat[None]),
        _table(e1, e2, inset.max(axis=0)[None], np.zeros((1, len(flat)))),
        _table(inset),
        np.full(len(triangles), part.material, np.uint16),
        corner_normals,
        bulge,
        bend,
        part.velocity,
        None if part.paint is None else Paint(part.paint.corners[has_area], part.paint.color_at),
        part.convex,
        part.behind,
    )


def _at_corners(normals: Floats64, triangles: NDArray[np.integer]) -> tuple[Floats64, Floats64]:
    """Normals (3, 3, T) at the corners of triangles (T, 3), as they are to be interpolated, and at unit length."""
    n = np.moveaxis(normals[triangles], 0, 2)
    lengths = np.sqrt(np.stack([dot(corner, corner) for corner in n]))
    if np.abs(lengths - 1).max(initial=0) < UNIT:
        return n, n
    # Only their ratios within a triangle count: its longest has length 1, so that no square leaves float32's range.
    unit = n / lengths[:, None]
    return unit * np.maximum(lengths / lengths.max(axis=0), FAINTEST)[:, None], unit


def _table(*rows: Floats) -> Floats32:
    """Rows of a triangle's numbers, (k, T) float64 together, as a table (T, k) float32."""
    return np.ascontiguousarray(np.concatenate(rows).T, np.float32)
