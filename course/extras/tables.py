"""From meshes to the tables of ``course.core.triangles``, and to the hierarchy of their triangles.

The scene has already been moved and scaled to [-1, 1], in float64.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from course.core.embree import Accelerator, EmbreeAccelerator
from course.core.motion import Motion, Mover, MovingAccelerator
from course.core.ray_offset import offset_and_inset
from course.core.triangles import Mesh, Triangles
from course.core.types import Floats, Floats32, Floats64, Functions, Numbers
from course.core.vectors import cross, dot
from course.extras.own import courses_own
from course.extras.swept_movers import SweptMovers

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
class Tables:
    """One part's rows of ``Triangles``; ``kept`` (T,) are the numbers of the mesh's triangles that have an area.

    Normals and bulge are empty if no part of the scene has normals.
    """

    part: Part
    kept: NDArray[np.intp]
    vertices: Floats32
    triangles: Numbers
    planes: Floats32
    edges: Floats32
    inset: Floats32
    corner_normals: Floats32
    bulge: Floats32
    largest_sine: float


def make_tables(parts: Sequence[Part], least_offset: float = 0.0) -> list[Tables]:
    """Tables of all parts, static ones first, then moving ones sorted by velocity. Coordinates lie in about [-1, 1].

    Triangles without area in float32 are left out: no ray can hit them. ``least_offset`` is the least distance from a
    surface at which rays leave it.
    """
    ordered = sorted(parts, key=lambda part: (part.velocity != STILL, part.velocity))
    smooth = any(part.mesh.normals is not None for part in ordered)
    empty = Part(Mesh(np.zeros((0, 3)), np.zeros((0, 3), np.intp)), 0)
    return [_tables(part, smooth, least_offset) for part in ordered or [empty]]


def join_tables(tables: Sequence[Tables], bulges: bool = True) -> Triangles:
    """The triangles of all parts; without ``bulges``, shadow rays start from the flat triangles."""
    smooth = any(t.part.mesh.normals is not None for t in tables)
    materials = [np.full(len(t.triangles), t.part.material, np.uint16) for t in tables]
    return Triangles(
        planes=np.concatenate([t.planes for t in tables]),
        edges=np.concatenate([t.edges for t in tables]),
        inset=np.concatenate([t.inset for t in tables]),
        corner_normals=np.concatenate([t.corner_normals for t in tables]) if smooth else None,
        bulge=np.concatenate([t.bulge for t in tables]) if smooth and bulges else None,
        largest_sine=max(t.largest_sine for t in tables),
        material=np.concatenate(materials),
        parts=tuple((len(t.vertices), len(t.triangles), t.part.convex) for t in tables),
    )


def accelerate(tables: Sequence[Tables], motion_blur: Functions | None = None) -> Accelerator:
    """One BVH for all static parts, and one for each velocity of moving parts, which need ``motion_blur``."""
    groups: dict[Velocity, list[Tables]] = {STILL: []}
    for table in tables:
        groups.setdefault(table.part.velocity, []).append(table)
    static = EmbreeAccelerator(*vertices_and_triangles(groups.pop(STILL)))
    if not groups:
        return static
    assert motion_blur is not None
    # A student's function may move a mover out of any box that is known beforehand.
    kind = SweptMovers if courses_own(motion_blur.to_object_space) else MovingAccelerator
    return kind(static, tuple(_movers(groups, tables)), Motion(motion_blur))


def vertices_and_triangles(tables: Sequence[Tables]) -> tuple[Floats32, Numbers]:
    """Vertices (V, 3) and triangles (T, 3) of several parts."""
    if not tables:
        return np.zeros((0, 3), np.float32), np.zeros((0, 3), np.int32)
    first = np.cumsum([0, *(len(table.vertices) for table in tables)])[:-1]
    triangles = [table.triangles + start for table, start in zip(tables, first, strict=True)]
    vertices = np.concatenate([table.vertices for table in tables])
    return vertices, np.concatenate(triangles).astype(np.int32)


def _movers(groups: dict[Velocity, list[Tables]], tables: Sequence[Tables]) -> Iterator[Mover]:
    """Movers in the order of their triangles, which follow the static ones."""
    moving = sum(len(table.triangles) for group in groups.values() for table in group)
    first = sum(len(table.triangles) for table in tables) - moving
    for velocity, group in groups.items():
        last = first + sum(len(table.triangles) for table in group)
        accelerator = EmbreeAccelerator(*vertices_and_triangles(group))
        yield Mover(np.array(velocity, np.float32), accelerator, first, last)
        first = last


def _tables(part: Part, smooth: bool, least_offset: float) -> Tables:
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
    offset, inset = offset_and_inset(p, lengths, twice_area)
    corner_normals, bulge = np.zeros((2, 0, 0), np.float32)
    largest_sine = 0.0
    flat = np.ones(len(triangles))
    if smooth:
        n = unit = np.repeat(ng[None], 3, axis=0)
        if mesh.normals is not None:
            n, unit = _at_corners(mesh.normals, triangles)
            # The file's normal is more precise: rounding vertices to float32 turns a small triangle.
            flat = (np.abs(n - ng) < FLAT).all(axis=(0, 1)) & (n == n[0]).all(axis=(0, 1))
            ng = np.where(flat, n[0], ng)
            cosine = min((float(dot(ng, corner).min(initial=1)) for corner in unit), default=1.0)
            largest_sine = math.sqrt(max(1 - cosine * cosine, 0)) if cosine > 0 else 1.0
        corner_normals = _table(n[0], n[1] - n[0], n[2] - n[0])
        d1, d2 = unit[1] - unit[0], unit[2] - unit[0]
        bulge = _table(np.stack((dot(e1, d1), dot(e2, d2), dot(e2 - e1, d2 - d1))) / 2)
    return Tables(
        part=part,
        kept=has_area,
        vertices=vertices,
        triangles=triangles.astype(np.int32),
        planes=_table(p[0], ng, np.maximum(offset, least_offset)[None], flat[None]),
        edges=_table(e1, e2, inset.max(axis=0)[None], np.zeros((1, len(flat)))),
        inset=_table(inset),
        corner_normals=corner_normals,
        bulge=bulge,
        largest_sine=largest_sine,
    )


def _at_corners(normals: Floats64, triangles: NDArray[np.integer]) -> tuple[Floats64, Floats64]:
    """Corner normals (3, 3, T), as interpolated and at unit length."""
    n = np.moveaxis(normals[triangles], 0, 2)
    lengths = np.sqrt(np.stack([dot(corner, corner) for corner in n]))
    if np.abs(lengths - 1).max(initial=0) < UNIT:
        return n, n
    # Only ratios within a triangle matter. The longest gets length 1, so that no square leaves float32's range.
    unit = n / lengths[:, None]
    return unit * np.maximum(lengths / lengths.max(axis=0), FAINTEST)[:, None], unit


def _table(*rows: Floats) -> Floats32:
    """Float64 rows, together (k, T), as a float32 table (T, k)."""
    return np.ascontiguousarray(np.concatenate(rows).T, np.float32)
