"""Where rays meet the surface: points, normals and a safe place to leave from, for the rays that hit something."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from course.core.gathering import gather
from course.core.types import Floats32, Indices, Mask, Materials, Numbers
from course.core.vectors import cross, dot
from course.geometry.behind import keep_normals
from course.geometry.convex import ConvexObjects, Objects
from course.geometry.embree import Intersections
from course.geometry.moving import MovingAccelerator
from course.geometry.surface import Surface

_Places = tuple[Floats32, Floats32, Floats32, Floats32, Floats32, Floats32]
"""p, ng, ns, offset, above, side; see ``Hits``."""

_Found = tuple[Indices | None, Numbers, Floats32, Floats32, Floats32, Materials, Floats32, _Places]
"""ray, triangle, u, v, t, material, direction; see ``Hits``."""

_ALL_RAYS = np.empty(0, np.int64)
_NOTHING_MET = np.empty(0, np.int32), np.empty((3, 0), np.float32), np.empty((3, 0), np.float32)
_NO_NORMALS = np.empty((3, 0), np.float32), np.empty((0, 9), np.float32)


@dataclass(frozen=True)
class Hits:
    """The hits of a batch, one column a hit.

    Attributes
    ----------
    ray : (n,) index of the ray in its batch, or None when every ray hit something
    triangle : (n,) int32, u, v : (n,) float32, which point of which triangle
    t : (n,) float32, distance along the ray
    material : (n,) uint16
    direction : (3, n) float32, of the ray that came in
    p : (3, n) float32, the point
    ng, ns : (3, n) float32, unit geometric and shading normals, on the incoming side of the triangle
    offset : (n,) float32, how far from the point rays leave
    above : (3, n) float32, where they leave on the incoming side, p + offset ng
    time : (n,) float32, when; None where nothing moves
    side : (n,) float32, 1 where the ray meets the front of the triangle, -1 where it meets the back
    tint : (3, n) float32, what textures say; 1 where there is none, None where none of the hits has one
    compiled : whether compiled loops are used
    convex : the scene's convex objects, where it pays to know which of them a ray leaves
    """

    ray: Indices | None
    triangle: Numbers
    u: Floats32
    v: Floats32
    t: Floats32
    material: Materials
    direction: Floats32
    p: Floats32
    ng: Floats32
    ns: Floats32
    offset: Floats32
    above: Floats32
    side: Floats32
    time: Floats32 | None = None
    tint: Floats32 | None = None
    compiled: bool = False
    convex: ConvexObjects | None = None

    @property
    def size(self) -> int:
        """Number of hits."""
        return len(self.t)

    @property
    def entering(self) -> Mask:
        """(n,) whether the ray comes from outside, the side that the front of the triangle looks to."""
        return np.asarray(self.side > 0)

    def below(self, which: Indices) -> Floats32:
        """(3, m) where refracted rays leave some of the hits from: as far off, on the far side."""
        below: Floats32 = self.p.take(which, axis=1)
        below -= self.ng.take(which, axis=1) * self.offset.take(which)
        return below

    def leaving(self, which: Indices, direction: Floats32) -> Objects | None:
        """The convex object that each of some rays leaves for good, (m,), -1 for none; None where nobody asks.

        Parameters
        ----------
        which : (m,) the hits that the rays leave
        direction : (3, m) of the rays
        """
        if self.convex is None:
            return None
        from course.geometry import hit_kernels

        left = np.empty(len(which), np.int8)
        arrays = which, self.triangle, self.side, self.ng, direction
        table = self.convex.first, self.convex.worth
        hit_kernels.leave(*map(np.ascontiguousarray, arrays), *table, left)
        return left


def find_hits(
    surface: Surface,
    found: Intersections,
    direction: Floats32,
    time: Floats32 | None = None,
    of_camera: bool = False,
) -> Hits:
    """Everything that shading needs to know about the hits of a batch of rays.

    Parameters
    ----------
    direction : (3, N) float32, unit length, of all rays of the batch
    time : (N,) float32 of all rays, None where nothing moves
    of_camera : whether they are camera rays
    """
    compiled = surface.accelerator.compiled
    find = _find_by_loop if compiled else _find
    ray, triangle, u, v, t, material, direction, places = find(surface, found, direction)
    p, ng, ns, offset, above, side = places
    if time is not None and ray is not None:
        time = time.take(ray)
    if isinstance(surface.accelerator, MovingAccelerator) and time is not None:
        surface.accelerator.follow(p, triangle, time)
        np.add(p, ng * offset, out=above)
    if surface.bent is not None and ns is not ng:
        some = np.flatnonzero(surface.bent.take(material))
        turned = ns.take(some, axis=1)
        _turn_to_viewer(turned, direction.take(some, axis=1))
        ns[:, some] = turned
    if of_camera and surface.kept is not None:
        keep_normals(surface.kept, triangle, side, p, ng, ns, offset, above)
    tint = None if surface.painting is None else surface.painting.tint(triangle, u, v)
    return Hits(
        *(ray, triangle, u, v, t, material, direction, p, ng, ns, offset, above, side),
        *(time, tint, compiled, surface.accelerator.convex),
    )


def _find(surface: Surface, found: Intersections, direction: Floats32) -> _Found:
    hit = np.flatnonzero(found.triangle >= 0)
    triangle, u, v, t = found.triangle, found.u, found.v, found.t
    ray: Indices | None = None
    if len(hit) < len(triangle):
        ray = hit
        triangle, u, v, t = triangle.take(hit), u.take(hit), v.take(hit), t.take(hit)
        direction = direction.take(hit, axis=1)
    places = _places(surface, triangle, u, v, direction)
    return ray, triangle, u, v, t, surface.material.take(triangle), direction, places


def _find_by_loop(surface: Surface, found: Intersections, direction: Floats32) -> _Found:
    """The same, to the same bits, in one loop."""
    from course.geometry import hit_kernels

    hit = np.flatnonzero(found.triangle >= 0)
    n = len(hit)
    triangle, u, v, t = found.triangle, found.u, found.v, found.t
    rays = tuple(map(np.ascontiguousarray, (triangle, u, v, t, direction)))
    ray: Indices | None = None
    met, uvt, arriving = _NOTHING_MET
    if n < len(triangle):
        ray = hit
        triangle = met = np.empty(n, np.int32)
        u, v, t = uvt = np.empty((3, n), np.float32)
        direction = arriving = np.empty((3, n), np.float32)
    material = np.empty(n, np.uint16)
    p, ng, above = np.empty((3, 3, n), np.float32)
    offset, side = np.empty((2, n), np.float32)
    ns, corner_normals = _NO_NORMALS
    if surface.corner_normals is not None:
        ns, corner_normals = np.empty((3, n), np.float32), surface.corner_normals
    hit_kernels.find(
        *(_ALL_RAYS if ray is None else hit, *rays),
        *(surface.planes, surface.edges, surface.inset, corner_normals),
        *(surface.material, surface.bent is None, met, uvt, arriving),
        *(material, p, ng, ns, offset, above, side),
    )
    places = p, ng, ng if surface.corner_normals is None else ns, offset, above, side
    return ray, triangle, u, v, t, material, direction, places


def _places(
    surface: Surface, triangle: Numbers, u: Floats32, v: Floats32, direction: Floats32
) -> _Places:
    """Points and normals of the hits, where things stand at time 0."""
    plane = gather(surface.planes, triangle)
    corner, ng, offset, flat = plane[0:3], plane[3:6], plane[6], plane[7]

    # From the corners, not origin + t * direction: its error is that of the triangle, however far the camera.
    edges = gather(surface.edges, triangle)
    p, along_2, widest = edges[0:3], edges[3:6], edges[6]
    p *= u
    along_2 *= v
    p += along_2
    p += corner
    _pull_off_edges(surface, p, triangle, u, v, widest)

    facing = dot(ng, direction)
    side = np.copysign(np.float32(1), -facing)
    ng *= side
    ns = ng
    if surface.corner_normals is not None:
        # Most triangles of a room have nothing to interpolate.
        some = np.flatnonzero(flat == 0)
        if len(some) == len(side):
            ns = _interpolated(surface, triangle, u, v, side, direction)
        else:
            ns = ng.copy()
            if len(some):
                ns[:, some] = _interpolated(
                    surface,
                    *(triangle.take(some), u.take(some), v.take(some), side.take(some)),
                    direction.take(some, axis=1),
                )
    above = ng * offset
    above += p
    return p, ng, ns, offset, above, side


def bulge(surface: Surface, hits: Hits, which: Indices) -> Floats32:
    """Height of the round surface above the triangle at some of the hits, on the incoming side.

    Parameters
    ----------
    which : (m,) which hits

    Returns
    -------
    (m,) float32, never negative; see ``course.geometry.surface``
    """
    if surface.bulge is None:
        return np.zeros(len(which), np.float32)
    u, v = hits.u.take(which), hits.v.take(which)
    w = 1 - u - v
    height = dot(gather(surface.bulge, hits.triangle.take(which)), np.stack((w * u, w * v, u * v)))
    height *= hits.side.take(which)
    return np.maximum(height, 0, out=height)


def _pull_off_edges(
    surface: Surface, p: Floats32, triangle: Numbers, u: Floats32, v: Floats32, widest: Floats32
) -> None:
    """Move the few points that lie next to an edge inwards, at right angles to it, in place."""
    w = 1 - u
    w -= v
    smallest = np.minimum(u, v)
    np.minimum(smallest, w, out=smallest)
    # Most points are far from every edge by the largest inset of their triangle; only the others' are looked up.
    near = np.flatnonzero(smallest < widest)
    inset = gather(surface.inset, triangle.take(near))
    close = (w.take(near) < inset[0]) | (u.take(near) < inset[1]) | (v.take(near) < inset[2])
    near, inset = near[close], inset[:, close]
    if len(near) == 0:
        return
    edges = surface.edges[triangle.take(near), :6].T.astype(np.float64)
    e1, e2 = edges[:3], edges[3:]
    ng = surface.planes[triangle.take(near), 3:6].T.astype(np.float64)
    twice_area = dot(cross(e1, e2), ng)
    moved = p[:, near].astype(np.float64)
    for edge, barycentric, least in zip((e2 - e1, -e2, e1), (w, u, v), inset, strict=True):
        # Twice the area over the edge's length is the height; over its square it makes the inward normal a unit one.
        lacking = np.maximum(least - barycentric.take(near), 0)
        moved += cross(ng, edge) * (lacking * twice_area / dot(edge, edge))
    p[:, near] = moved


def _interpolated(
    surface: Surface,
    triangle: Numbers,
    u: Floats32,
    v: Floats32,
    side: Floats32,
    direction: Floats32,
) -> Floats32:
    """Shading normals (3, n) on the incoming side."""
    assert surface.corner_normals is not None
    rows = gather(surface.corner_normals, triangle)
    normal = rows[3:6]
    normal *= u
    rows[6:9] *= v
    normal += rows[6:9]
    normal += rows[0:3]
    squared = dot(normal, normal)
    # Opposite corner normals may cancel; any unit vector is as good as another there.
    np.maximum(squared, np.float32(1e-20), out=squared)
    normal *= 1 / np.sqrt(squared)
    normal *= side
    if surface.bent is None:
        _turn_to_viewer(normal, direction)
    return normal


def _turn_to_viewer(ns: Floats32, direction: Floats32) -> None:
    """Shading normals that look away from the ray are bent until they are orthogonal to it, in place."""
    away = dot(ns, direction)
    wrong = np.flatnonzero(away > 0)
    if len(wrong):
        d = direction.take(wrong, axis=1)
        bent = ns.take(wrong, axis=1)
        bent -= away.take(wrong) * d
        squared = dot(bent, bent)
        np.maximum(squared, np.float32(1e-20), out=squared)
        bent *= 1 / np.sqrt(squared)
        ns[:, wrong] = bent
