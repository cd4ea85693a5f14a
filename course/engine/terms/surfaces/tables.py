"""From meshes to the tables of ``course.engine.core.triangles``, and to the hierarchy of their triangles.

The scene has already been moved and scaled to [-1, 1], in float64.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import chain

import numpy as np
from numpy.typing import NDArray

from course.engine.casters.choice import static_accelerator
from course.engine.core.accelerator import Accelerator
from course.engine.core.motion import Motion, Mover, MovingAccelerator
from course.engine.core.ray_offset import offset_and_inset
from course.engine.core.triangles import Triangles
from course.engine.core.types import Floats, Floats32, Floats64, Functions, Numbers
from course.engine.core.vectors import cross, dot
from course.engine.functions.own import courses_own
from course.engine.shapes.mesh import Mesh
from course.engine.terms.surfaces.swept_movers import SweptMovers

CHUNK = 8192
"""Triangles whose tables are made at once: numbers in between are 600 bytes a triangle, which stay in the cache."""

UNIT = 1e-9
"""Normals whose lengths are within this of 1 count as unit vectors."""

FLAT = 1e-5
"""A triangle is flat if its corner normals are equal and each component is within this of ng's."""

FAINTEST = 2.0**-24
"""Least length of a corner normal relative to its triangle's longest: negligible in float32, but never 0."""


Velocity = tuple[float, float, float]

STILL: Velocity = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Part:
    """One object's mesh, before its tables are made.

    Attributes
    ----------
    material : material number
    velocity : [units of the compiled scene / exposure]
    convex : true if the mesh is closed, its triangles face outwards, and no ray that leaves it hits it again
    """

    mesh: Mesh
    material: int
    velocity: Velocity = STILL
    convex: bool = False


@dataclass(frozen=True)
class Rows:
    """Rows of ``Triangles``; normals and bulge are empty if no part of the scene has normals."""

    planes: Floats32
    edges: Floats32
    inset: Floats32
    corner_normals: Floats32
    bulge: Floats32

    @classmethod
    def empty(cls, count: int, smooth: bool) -> Rows:
        """Room for so many triangles."""
        widths = (8, 8, 3, *((9, 3) if smooth else (0, 0)))
        return cls(*(np.empty((count, width), np.float32) for width in widths))

    def __getitem__(self, rows: slice) -> Rows:
        arrays = self.planes, self.edges, self.inset, self.corner_normals, self.bulge
        return Rows(*(array[rows] for array in arrays))


@dataclass(frozen=True)
class PartTables:
    """One part's share of ``Triangles``.

    Attributes
    ----------
    kept : (T,) the numbers of the mesh's triangles that have an area
    largest_sine, largest_raised : see ``Triangles``
    """

    part: Part
    kept: NDArray[np.intp]
    vertices: Floats32
    triangles: Numbers
    rows: Rows
    largest_sine: float
    largest_raised: float


def make_tables(parts: Sequence[Part], least_offset: float = 0.0) -> tuple[list[PartTables], Rows]:
    """Tables of all parts, static ones first, then moving ones sorted by velocity, and the rows of all.

    Triangles without area in float32 are left out: no ray can hit them. Coordinates lie in about [-1, 1].
    ``least_offset`` is the least distance from a surface at which rays leave it.
    """
    ordered = sorted(parts, key=lambda part: (part.velocity != STILL, part.velocity))
    smooth = any(part.mesh.normals is not None for part in ordered)
    if not ordered:
        ordered = [Part(Mesh(np.zeros((0, 3)), np.zeros((0, 3), np.intp)), 0)]
    rows = Rows.empty(sum(len(part.mesh.triangles) for part in ordered), smooth)
    tables, count = list[PartTables](), 0
    for part in ordered:
        tables.append(_tables(part, rows[count:], smooth, least_offset))
        count += len(tables[-1].triangles)
    return tables, rows[:count]


def join_tables(tables: Sequence[PartTables], rows: Rows, bulges: bool = True) -> Triangles:
    """The triangles of all parts; without ``bulges``, shadow rays start from the flat triangles."""
    smooth = any(t.part.mesh.normals is not None for t in tables)
    counts = [len(t.triangles) for t in tables]
    return Triangles(
        planes=rows.planes,
        edges=rows.edges,
        inset=rows.inset,
        corner_normals=rows.corner_normals if smooth else None,
        bulge=rows.bulge if smooth and bulges else None,
        largest_sine=max(t.largest_sine for t in tables),
        largest_raised=max(t.largest_raised for t in tables),
        material=np.repeat(np.array([t.part.material for t in tables], np.uint16), counts),
        parts=tuple((len(t.vertices), len(t.triangles), t.part.convex) for t in tables),
    )


def accelerate(tables: Sequence[PartTables], motion_blur: Functions | None = None) -> Accelerator:
    """One BVH for all static parts, and one for each velocity of moving parts, which need ``motion_blur``."""
    groups: dict[Velocity, list[PartTables]] = {STILL: []}
    for table in tables:
        groups.setdefault(table.part.velocity, []).append(table)
    static = static_accelerator(*vertices_and_triangles(groups.pop(STILL)))
    if not groups:
        return static
    assert motion_blur is not None
    # A student's function may move a mover out of any box that is known beforehand.
    kind = SweptMovers if courses_own(motion_blur.to_object_space) else MovingAccelerator
    return kind(static, tuple(_movers(groups, tables)), Motion(motion_blur))


def vertices_and_triangles(tables: Sequence[PartTables]) -> tuple[Floats32, Numbers]:
    """Vertices (V, 3) and triangles (T, 3) of several parts."""
    if len(tables) == 1:
        return tables[0].vertices, tables[0].triangles
    if not tables:
        return np.zeros((0, 3), np.float32), np.zeros((0, 3), np.int32)
    first = np.cumsum([0, *(len(table.vertices) for table in tables)], dtype=np.int32)[:-1]
    triangles = np.concatenate([table.triangles for table in tables])
    triangles += np.repeat(first, [len(table.triangles) for table in tables])[:, None]
    return np.concatenate([table.vertices for table in tables]), triangles


def _movers(
    groups: dict[Velocity, list[PartTables]], tables: Sequence[PartTables]
) -> Iterator[Mover]:
    """Movers in the order of their triangles, which follow the static ones."""
    moving = sum(len(table.triangles) for group in groups.values() for table in group)
    first = sum(len(table.triangles) for table in tables) - moving
    for velocity, group in groups.items():
        last = first + sum(len(table.triangles) for table in group)
        accelerator = static_accelerator(*vertices_and_triangles(group))
        yield Mover(np.array(velocity, np.float32), accelerator, first, last)
        first = last


def _tables(part: Part, rows: Rows, smooth: bool, least_offset: float) -> PartTables:
    """Tables of a part, whose rows are the first of ``rows``."""
    mesh = part.mesh
    # Rounded to float32 once, so that every number below agrees with Embree's vertices.
    vertices = mesh.vertices.astype(np.float32)
    normals = mesh.normals
    unit = normals is not None and _are_unit(normals)
    kept, count, largest = [np.empty(0, np.intp)], 0, (0.0, 0.0)
    for first in range(0, len(mesh.triangles), CHUNK):
        corners = mesh.triangles[first : first + CHUNK]
        p = np.ascontiguousarray(np.moveaxis(vertices[corners], 0, 2), np.float64)
        ng: Floats64 = np.asarray(cross(p[1] - p[0], p[2] - p[0]), np.float64)
        has_area = np.flatnonzero(dot(ng, ng) > 0)
        if len(has_area) < len(corners):
            corners, p, ng = corners[has_area], p[:, :, has_area], ng[:, has_area]
        own = None if normals is None else _normals(normals[corners], unit)
        chunk = rows[count : count + len(corners)]
        found = _fill(chunk, p, ng, mesh.vertices, corners, own, smooth, least_offset)
        largest = max(largest[0], found[0]), max(largest[1], found[1])
        kept.append(first + has_area)
        count += len(has_area)
    numbers = np.concatenate(kept)
    triangles = mesh.triangles if count == len(mesh.triangles) else mesh.triangles[numbers]
    whole = triangles.astype(np.int32, copy=False)
    return PartTables(part, numbers, vertices, whole, rows[:count], *largest)


def _fill(
    rows: Rows,
    p: Floats64,
    ng: Floats64,
    vertices: Floats64,
    corners: NDArray[np.integer],
    normals: tuple[Floats64, Floats64] | None,
    smooth: bool,
    least_offset: float,
) -> tuple[float, float]:
    """Fill the rows of T triangles; returns ``largest_sine`` and ``largest_raised`` of ``PartTables``.

    Parameters
    ----------
    p, ng : (3, 3, T) corners and (3, T) cross products of edges, none of them 0
    vertices, corners : the mesh's, not rounded, and (T, 3) their numbers
    normals : see ``_normals``; None if the mesh has none
    smooth : true if any part has normals
    """
    e1, e2 = p[1] - p[0], p[2] - p[0]
    twice_area = np.sqrt(dot(ng, ng))
    ng = ng / twice_area
    lengths = np.sqrt(np.stack([dot(e, e) for e in (e2 - e1, e2, e1)]))
    offset, inset, thin = offset_and_inset(p, lengths, twice_area)
    largest_sine = largest_raised = 0.0
    if len(thin):
        largest_raised = float(offset[thin].max())
        ng[:, thin] = _unrounded(vertices[corners[thin]], ng[:, thin])
    flat = np.ones(p.shape[2])
    if smooth:
        n = unit = np.repeat(ng[None], 3, axis=0)
        if normals is not None:
            n, unit = normals
            # The file's normal is more precise: rounding vertices to float32 turns a small triangle.
            flat = (n[1:] == n[0]).all(axis=(0, 1))
            some = np.flatnonzero(flat)
            flat[some] = (np.abs(n[0][:, some] - ng[:, some]) < FLAT).all(axis=0)
            ng = np.where(flat, n[0], ng)
            cosine = min((float(dot(ng, corner).min(initial=1)) for corner in unit), default=1.0)
            largest_sine = math.sqrt(max(1 - cosine * cosine, 0)) if cosine > 0 else 1.0
        _put(rows.corner_normals, n[0], n[1] - n[0], n[2] - n[0])
        d1, d2 = unit[1] - unit[0], unit[2] - unit[0]
        _put(rows.bulge, np.stack((dot(e1, d1), dot(e2, d2), dot(e2 - e1, d2 - d1))) / 2)
    _put(rows.planes, p[0], ng, np.maximum(offset, least_offset)[None], flat[None])
    _put(rows.edges, e1, e2, inset.max(axis=0)[None], np.zeros((1, len(flat))))
    _put(rows.inset, inset)
    return largest_sine, largest_raised


def _unrounded(corners: Floats64, rounded: Floats64) -> Floats64:
    """Unit normals (3, T) of thin triangles (T, 3 corners, 3) before their corners were rounded to float32.

    Rounding turns a thin triangle about its length, though no point of it moves by more than its corners. Its rays
    leave the surface that it stands for: above the rounded triangle, they would go down into its neighbours.
    ``rounded``: (3, T), the normals afterwards, which those without area before keep
    """
    p = np.moveaxis(corners, 0, 2)
    ng = cross(p[1] - p[0], p[2] - p[0])
    length = np.sqrt(dot(ng, ng))
    return np.where(length > 0, ng / np.maximum(length, np.finfo(np.float64).tiny), rounded)


def _are_unit(normals: Floats64) -> bool:
    """True if all normals (V, 3) have length 1."""
    lengths = np.sqrt(np.einsum("ij,ij->i", normals, normals))
    return bool(np.abs(lengths - 1).max(initial=0) < UNIT)


def _normals(at_corners: Floats64, unit: bool) -> tuple[Floats64, Floats64]:
    """Corner normals (3 corners, 3, T), as interpolated and at unit length, of (T, 3 corners, 3).

    ``unit`` is true if they have it already.
    """
    n = np.moveaxis(at_corners, 0, 2)
    if unit:
        return n, n
    lengths = np.sqrt(np.stack([dot(corner, corner) for corner in n]))
    # Only ratios within a triangle matter. The longest gets length 1, so that no square leaves float32's range.
    units = n / lengths[:, None]
    return units * np.maximum(lengths / lengths.max(axis=0), FAINTEST)[:, None], units


def _put(table: Floats32, *rows: Floats) -> None:
    """Fill a float32 table (T, k) with float64 rows, together (k, T)."""
    # Row by row: an array of all of them would be made and copied for nothing.
    for column, row in zip(table.T, chain.from_iterable(rows), strict=True):
        column[:] = row
