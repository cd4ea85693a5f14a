"""Meshes of glass that enclose nothing: where one says no inside and outside, light is bent and absorbed wrongly."""

import warnings
from collections import defaultdict
from collections.abc import Sequence

import numpy as np

from course.base.errors import CourseWarning
from course.engine.core.types import Indices, Mask
from course.engine.formats.meshes.parts import same
from course.engine.formats.yaml import description as d
from course.engine.formats.yaml.loading import Loaded
from course.engine.shapes.mesh import Mesh


def warn_of_glass(loaded: Loaded, meshes: Sequence[Mesh]) -> None:
    """Warn of each mesh of a file that is a dielectric, and not closed, or inside out.

    Dielectrics may close each other. Where a tumbler's mesh is open at the water's edge, two others are: between water
    and glass, and between water and air. Two parts of one material need no third.
    """
    scene = loaded.description
    if scene.integrator.into_surface != "mirror":
        # The picture is another renderer's, whose scenes have glass of single sides.
        return
    clear = [
        number
        for number, thing in enumerate(scene.objects)
        if isinstance(thing, d.MeshFile) and scene.materials[thing.material].dielectric is not None
    ]
    troubles = {number: wrong_inside(meshes[number]) for number in clear}
    if not any(troubles.values()):
        return
    rims = {number: _rim(meshes[number]) for number in clear}
    at = defaultdict[bytes, list[int]](list)
    for number, rim in rims.items():
        for edge in rim:
            at[edge].append(number)
    for number, trouble in troubles.items():
        thing, rim = scene.objects[number], rims[number]
        assert isinstance(thing, d.MeshFile)
        others = [[scene.objects[other] for other in at[edge] if other != number] for edge in rim]
        closed = bool(rim) and all(sum(_closing(o, thing) for o in each) >= 2 for each in others)
        if trouble and not closed:
            warnings.warn(
                f"{loaded.document.where(('objects', number))}: {thing.file} is of glass, {thing.material}, but"
                f" {trouble}",
                CourseWarning,
                stacklevel=2,
            )


def _closing(other: d.Object, thing: d.Object) -> int:
    """What another object, open at the same edge, counts: from 2 on they close a thing there."""
    if other.motion != thing.motion:
        return 0
    return 2 if other.material == thing.material else 1


def wrong_inside(mesh: Mesh) -> str | None:
    """What keeps a mesh from enclosing glass, and what helps; None where nothing does."""
    used = mesh.vertices[mesh.triangles.ravel()]
    if np.linalg.matrix_rank(used - used[0], tol=1e-6 * np.ptp(used)) < 3:
        # One flat side is where glass begins, and all behind it is glass.
        return None
    corners = _corners(mesh)
    start, end, _ = _edges(corners)
    edge, uses = _uses(corners)
    if is_open := int(np.count_nonzero(uses % 2)):
        return f"it is open at {is_open:,} edges: it has no inside; close it"
    ahead = np.bincount(edge, weights=np.where(start < end, 1, -1))
    if turned := int(np.count_nonzero(ahead)):
        return f"triangles at {turned:,} edges are wound against each other: no side is the inside; turn some"
    return _wrong_side(mesh, corners)


def _corners(mesh: Mesh) -> Indices:
    """Vertices (T, 3) of the triangles that have three; those at one place are one where the mesh isn't closed so."""
    corners = mesh.triangles.astype(np.int64)
    if not _closed(corners):
        # Such as those of an STL file or at a seam.
        corners = same(*mesh.vertices.T)[1][corners]
    sides = np.sort(corners, axis=1)
    whole: Mask = (sides[:, 1:] != sides[:, :-1]).all(axis=1)
    return corners[whole]


def _uses(corners: Indices) -> tuple[Indices, Indices]:
    """The edge of each side (3 T,), and how many sides each edge has."""
    start, end, count = _edges(corners)
    _, edge, uses = np.unique(
        np.minimum(start, end) * count + np.maximum(start, end),
        return_inverse=True,
        return_counts=True,
    )
    return edge.ravel(), uses


def _rim(mesh: Mesh) -> set[bytes]:
    """Where the open edges are: the places of their ends, in order."""
    corners = _corners(mesh)
    edge, uses = _uses(corners)
    is_open = uses[edge] % 2 == 1
    start, end, _ = _edges(corners)
    # Where any is open, corners are numbered by place.
    places = mesh.vertices[same(*mesh.vertices.T)[0]] if is_open.any() else mesh.vertices
    ends = np.stack((places[start[is_open]], places[end[is_open]]), axis=1) + 0.0
    return {min(a.tobytes() + b.tobytes(), b.tobytes() + a.tobytes()) for a, b in ends}


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
