"""Large triangles beside small things, cut where these are, so that offsets and rounding shrink with the distance.

The rounding of a hit point, and the distance by which rays leave it, are shares of the largest coordinate of its
triangle (``course.engine.core.triangles``). Beside a thing of size s at distance d a triangle of the extent R is too
large if R is many times max(s, d). It is halved until it isn't, or until its largest coordinate is that of the place
where it lies, which no cut makes smaller: small things should lie near the origin
(``course.engine.scene.building.small_objects``).

Before that, long thin triangles are cut across (``course.engine.scene.building.slicing``).

No ray slips through: triangles that share an edge share the corners that it is cut at, to the last bit, whichever
object they belong to. Data of corners are interpolated for new corners as they are at hits, so no hit changes.

Newest vertex bisection: each triangle has one edge that is its next to be halved, from corner 0 to corner 1; the
middle of that edge is joined to corner 2. The children's next edges are the parent's two others. When an edge is
halved, the triangle on its other side has to be halved there as well, for which its own next edge may have to go
first. Angles never get smaller than half of what they were. (Mitchell, "Adaptive refinement for arbitrary
finite-element spaces with hierarchical bases", 1991.)
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from course.engine.core.types import Floats64, Indices, Mask
from course.engine.formats.meshes.parts import same
from course.engine.scene.building.slicing import sliced, too_thin
from course.engine.scene.building.triangles import (
    NEAR,
    TOO_LARGE,
    SharedTriangles,
    SmallThings,
    ends_of,
    largest,
    nearest_of,
)
from course.engine.shapes.mesh import Mesh
from course.engine.terms.surfaces.painting import Paint
from course.engine.terms.surfaces.surface import FullPart


def undivided(vertices: Floats64, corners: Indices) -> SharedTriangles:
    """Triangles as they come from a mesh, their longest edges next."""
    p = vertices[corners]
    edges = np.linalg.norm(np.roll(p, -1, axis=1) - p, axis=2)
    # Edges that are equally long to rounding: of two triangles of a square both take the diagonal, or neither.
    first = (edges > edges.max(axis=1, keepdims=True) * (1 - 1e-6)).argmax(axis=1)
    turned = corners[np.arange(len(corners))[:, None], (first[:, None] + np.arange(3)) % 3]
    return SharedTriangles(vertices, turned, np.arange(len(corners)))


def bisected(triangles: SharedTriangles, chosen: Mask) -> SharedTriangles:
    """Halve the chosen triangles, and those that have to be halved with them.

    ``chosen``: (T,) bool.
    """
    corners = triangles.corners
    pairs = np.sort(np.stack((corners, np.roll(corners, -1, axis=1)), axis=2), axis=2)
    ends, edge = np.unique(pairs.reshape(-1, 2), axis=0, return_inverse=True)
    edge = edge.reshape(-1, 3)
    halved = np.zeros(len(ends), bool)
    halved[edge[chosen, 0]] = True
    while True:
        # If any edge of a triangle is halved, its next one has to be halved, too.
        behind = halved[edge].any(axis=1) & ~halved[edge[:, 0]]
        if not behind.any():
            break
        halved[edge[behind, 0]] = True
    middle = np.full(len(ends), -1)
    middle[halved] = len(triangles.vertices) + np.arange(int(halved.sum()))
    a, b = triangles.vertices[ends[halved]].transpose(1, 0, 2)
    vertices = np.concatenate((triangles.vertices, a / 2 + b / 2))
    parts = _halves(corners, middle[edge], triangles.origin)
    return SharedTriangles(vertices, np.concatenate(parts[0]), np.concatenate(parts[1]))


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


CANCELLED = 1e-9
"""Length of a normal that has none, as short as float32 has them beside others."""

MOST = 50_000
"""Pieces from which on nothing more is cut: a thing beside a floor takes some hundred, but needles that lie over each
other, a million times as long as wide, could take any number."""


def cut(parts: list[FullPart], things: SmallThings, ratio: float) -> list[FullPart]:
    """The same surfaces, with triangles cut that are too thin or too large for what lies beside them.

    Parameters
    ----------
    parts : whose coordinates lie in about [-1, 1]
    things : in the same coordinates
    ratio : how many times as large as what lies beside it a triangle may be
    """
    vertices = np.concatenate([part.mesh.vertices for part in parts])
    first = np.cumsum([0, *(len(part.mesh.vertices) for part in parts)])
    corners = np.concatenate(
        [part.mesh.triangles + start for part, start in zip(parts, first, strict=False)]
    ).astype(np.intp)
    p = vertices[corners]
    if not (_too_large(p, things, ratio).any() or too_thin(p, things).any()):
        return parts
    # Embree sees float32: what is one place there is one here.
    rounded = vertices.astype(np.float32)
    places, place = same(*rounded.T)
    pieces = _cut(sliced(vertices[places], place[corners], things), things, ratio)
    ends = np.cumsum([len(part.mesh.triangles) for part in parts])
    counts = np.bincount(pieces.origin, minlength=len(corners))
    halved = np.flatnonzero(counts[pieces.origin] > 1)
    owner = np.searchsorted(ends, pieces.origin[halved], side="right")
    found = []
    for number, (part, end) in enumerate(zip(parts, ends, strict=True)):
        mine = halved[owner == number]
        if len(mine):
            begin = end - len(part.mesh.triangles)
            at = pieces.vertices[pieces.corners[mine]]
            part = _with_pieces(part, at, pieces.origin[mine] - begin)
        found.append(part)
    return found


def unfinished(parts: Sequence[FullPart], things: SmallThings) -> list[int]:
    """Numbers of the parts with triangles that should have been cut further, by far; see ``MOST``."""
    coarse = 16 * TOO_LARGE
    corners = [part.mesh.vertices[part.mesh.triangles] for part in parts]
    return [
        number
        for number, p in enumerate(corners)
        if _too_large(p, things, coarse).any() or too_thin(p, things, coarse).any()
    ]


def _too_large(p: Floats64, things: SmallThings, ratio: float) -> Mask:
    """Mask (T,) of the triangles (T, 3 corners, 3) to be halved."""
    low, high = ends_of(p)
    reach, nearest = largest(np.maximum(-low, high)), nearest_of(low, high)
    large: Mask = reach > np.maximum(NEAR * nearest, ratio * things.least)
    some = np.flatnonzero(large)
    large[some] = reach[some] > ratio * things.limit(low[some], high[some])
    return large


def _cut(whole: SharedTriangles, things: SmallThings, ratio: float) -> SharedTriangles:
    """All triangles, those that are too large in pieces, and those that have to be halved with them."""
    corners = whole.corners
    # Triangles with two equal corners have no area in float32, and are ignored.
    there = (corners != np.roll(corners, 1, axis=1)).all(axis=1)
    inside = there & _too_large(whole.vertices[corners], things, ratio)
    while True:
        numbers = np.flatnonzero(inside)
        pieces = undivided(whole.vertices, corners[numbers])
        edges = _edges(corners[numbers])
        while len(pieces.corners) < MOST:
            chosen = _too_large(pieces.vertices[pieces.corners], things, ratio)
            if not chosen.any():
                break
            pieces = bisected(pieces, chosen)
            # Always the longest edge, or needles would be halved along as often as across, into ever more of them.
            turned = undivided(pieces.vertices, pieces.corners)
            pieces = replace(turned, origin=pieces.origin)
        # Whose edges are halved, though nobody has asked: they have to come in, and all is done again.
        gone = np.setdiff1d(edges, _edges(pieces.corners))
        outside = np.flatnonzero(there & ~inside)
        touched = np.isin(_edges(corners[outside]), gone).reshape(-1, 3).any(axis=1)
        if not touched.any():
            break
        inside[outside[touched]] = True
    return SharedTriangles(
        pieces.vertices,
        np.concatenate((corners[~inside], pieces.corners)),
        np.concatenate((whole.origin[~inside], whole.origin[numbers[pieces.origin]])),
    )


def _edges(corners: Indices) -> Indices:
    """(3 T,) a number for each edge, the same for both of its triangles."""
    ends = np.sort(np.stack((corners, np.roll(corners, -1, axis=1)), axis=2), axis=2).reshape(-1, 2)
    numbers: Indices = (ends[:, 0] << 32) + ends[:, 1]
    return numbers


def _with_pieces(part: FullPart, at: Floats64, parent: Indices) -> FullPart:
    """A part with some of its triangles replaced by pieces of theirs.

    Parameters
    ----------
    at : (P, 3 corners, 3) where the pieces lie
    parent : (P,) whose pieces they are
    """
    mesh = part.mesh
    whole = np.ones(len(mesh.triangles), np.bool_)
    whole[parent] = False
    weights = _barycentrics(mesh.vertices[mesh.triangles[parent]], at)

    def carried(rows: Floats64) -> Floats64:
        """At the pieces' corners, (3 P, k), what is (P, 3 corners, k) at their parents'."""
        # In this form what is the same at all corners is the same in between, to the last bit.
        start = rows[:, 0]
        u, v = weights[..., :1], weights[..., 1:]
        between = (
            start[:, None] + u * (rows[:, 1] - start)[:, None] + v * (rows[:, 2] - start)[:, None]
        )
        return between.reshape(-1, rows.shape[2])

    def joined(rows: Floats64 | None) -> Floats64 | None:
        return (
            None if rows is None else np.concatenate((rows, carried(rows[mesh.triangles[parent]])))
        )

    normals = joined(mesh.normals)
    if normals is not None:
        # If opposite normals cancel, any direction is right, but there must be one.
        normals[~normals.any(axis=1)] = (CANCELLED, 0, 0)
    own = len(mesh.vertices) + np.arange(3 * len(at)).reshape(-1, 3)
    pieces = Mesh(
        np.concatenate((mesh.vertices, at.reshape(-1, 3))),
        np.concatenate((mesh.triangles[whole], own)),
        normals,
        joined(mesh.uv),
    )

    def repainted(paint: Paint | None) -> Paint | None:
        if paint is None:
            return None
        corners = carried(paint.corners[parent]).reshape(-1, 3, 3)
        return replace(paint, corners=np.concatenate((paint.corners[whole], corners)))

    paint, relief, shine = map(repainted, (part.paint, part.relief, part.shine))
    return replace(part, mesh=pieces, paint=paint, relief=relief, shine=shine)


def _barycentrics(p: Floats64, at: Floats64) -> Floats64:
    """Barycentrics (P, k, 2) of the corners 1 and 2 of triangles (P, 3, 3) at points (P, k, 3) on them."""
    e1, e2 = p[:, None, 1] - p[:, None, 0], p[:, None, 2] - p[:, None, 0]
    away = at - p[:, None, 0]
    normal = np.cross(e1, e2)
    # A triangle without area is as good as none: what its pieces carry is of no consequence, but must be finite.
    normal /= np.maximum((normal * normal).sum(axis=2, keepdims=True), np.finfo(np.float64).tiny)
    u, v = np.cross(away, e2) * normal, np.cross(e1, away) * normal
    return np.stack((u.sum(axis=2), v.sum(axis=2)), axis=2)
