"""Meshes of glass that enclose nothing: where one says no inside and outside, light is bent and absorbed wrongly."""

import warnings
from collections.abc import Sequence

import numpy as np

from course.base.errors import CourseWarning
from course.engine.core.types import Indices
from course.engine.formats.meshes.parts import same
from course.engine.formats.yaml import description as d
from course.engine.formats.yaml.loading import Loaded
from course.engine.shapes.mesh import Mesh


def warn_of_glass(loaded: Loaded, meshes: Sequence[Mesh]) -> None:
    """Warn of each mesh of a file that is a dielectric, and not closed, or inside out."""
    scene = loaded.description
    if scene.integrator.into_surface != "mirror":
        # The picture is another renderer's, whose scenes have glass of single sides.
        return
    for number, (thing, mesh) in enumerate(zip(scene.objects, meshes, strict=True)):
        material = scene.materials[thing.material]
        if not isinstance(thing, d.MeshFile) or material.dielectric is None:
            continue
        if trouble := wrong_inside(mesh):
            warnings.warn(
                f"{loaded.document.where(('objects', number))}: {thing.file} is of glass, {thing.material}, but"
                f" {trouble}",
                CourseWarning,
                stacklevel=2,
            )


def wrong_inside(mesh: Mesh) -> str | None:
    """What keeps a mesh from enclosing glass, and what helps; None where nothing does."""
    corners = mesh.triangles.astype(np.int64)
    if not _closed(corners):
        # Vertices at one place are one, such as those of an STL file or at a seam.
        corners = same(*mesh.vertices.T)[1][corners]
    sides = np.sort(corners, axis=1)
    corners = corners[(sides[:, 1:] != sides[:, :-1]).all(axis=1)]
    start, end, count = _edges(corners)
    _, edge, uses = np.unique(
        np.minimum(start, end) * count + np.maximum(start, end),
        return_inverse=True,
        return_counts=True,
    )
    ahead = np.bincount(edge.ravel(), weights=np.where(start < end, 1, -1))
    used = mesh.vertices[mesh.triangles.ravel()]
    if np.linalg.matrix_rank(used - used[0], tol=1e-6 * np.ptp(used)) < 3:
        # One flat side is where glass begins, and all behind it is glass.
        return None
    if is_open := int(np.count_nonzero(uses % 2)):
        return f"it is open at {is_open:,} edges: it has no inside; close it"
    if turned := int(np.count_nonzero(ahead)):
        return f"triangles at {turned:,} edges are wound against each other: no side is the inside; turn some"
    return _wrong_side(mesh, corners)


def _wrong_side(mesh: Mesh, corners: Indices) -> str | None:
    """The same of a mesh whose edges have as many triangles on the one side as on the other."""
    sides = np.sort(corners, axis=1)
    double = len(sides) - len(np.unique(sides, axis=0))
    if double:
        return f"{double:,} of its triangles lie on others: it is two-sided, and has no inside; leave one of them"
    p = mesh.vertices[mesh.triangles]
    p = p - p.mean(axis=(0, 1))
    p /= np.abs(p).max(initial=1e-300)
    if np.sum(p[:, 0] * np.cross(p[:, 1], p[:, 2])) < 0:
        return "it is inside out: its triangles look inwards; turn them"
    return None


def _edges(corners: Indices) -> tuple[Indices, Indices, int]:
    """First and second vertex of each side of each triangle, and a number that is larger than all of these."""
    start, end = corners.ravel(), np.roll(corners, -1, axis=1).ravel()
    return start, end, int(corners.max(initial=0)) + 1


def _closed(corners: Indices) -> bool:
    """Whether each side of a triangle is that of another one, from the other side."""
    start, end, count = _edges(corners)
    return np.array_equal(np.sort(start * count + end), np.sort(end * count + start))
