"""Hits of a batch of rays: points, normals, and origins of the rays that leave them."""

from dataclasses import dataclass, replace

import numpy as np

from course.engine.core.accelerator import Accelerator, Intersections, QueryStats
from course.engine.core.motion import MovingAccelerator
from course.engine.core.ray_offset import pull_off_edges
from course.engine.core.rays import Rays
from course.engine.core.triangles import Triangles
from course.engine.core.types import Floats32, Indices, Mask, Materials, Numbers
from course.engine.core.vectors import dot, gather, normalise


@dataclass(frozen=True)
class Hits:
    """The hits of a batch, one column per hit.

    Attributes
    ----------
    ray : (n,) index of the ray in its batch; None if every ray hit
    triangle : (n,) int32
    u, v : (n,) float32 barycentrics
    t : (n,) float32, distance along the ray
    material : (n,) uint16 material number
    direction : (3, n) float32, of the incoming ray
    p : (3, n) float32, the point
    ng, ns : (3, n) float32, unit geometric and shading normals, on the incoming side
    offset : (n,) float32, distance from p at which rays begin (``course.engine.core.ray_offset``)
    near_origin : (3, n) float32, p + offset ng, pulled off edges: the origins of rays that leave on the incoming side
    side : (n,) float32, 1 at the front of the triangle, -1 at the back
    time : (n,) float32, share of the exposure; None if nothing moves
    tint : (3, n) float32, colour factor of textures, 1 at hits without a texture; None without textures
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
    near_origin: Floats32
    side: Floats32
    time: Floats32 | None = None
    tint: Floats32 | None = None

    @property
    def size(self) -> int:
        """Number of hits."""
        return len(self.t)

    @property
    def entering(self) -> Mask:
        """(n,) bool, true where the ray hits the front of the triangle, from outside."""
        return np.asarray(self.side > 0)

    def far_origin(self, which: Indices) -> Floats32:
        """The same on the far side, (3, m), of hits ``which`` (m,)."""
        twice = 2 * self.offset.take(which)
        origin: Floats32 = self.near_origin.take(which, axis=1)
        origin -= self.ng.take(which, axis=1) * twice
        return origin


@dataclass(frozen=True)
class Surface:
    """All triangles of a scene, and the accelerator that intersects rays with them."""

    triangles: Triangles
    accelerator: Accelerator

    @property
    def turns_normals(self) -> bool:
        """True if ``turn_to_viewer`` turns interpolated shading normals; a subclass may leave them as they are."""
        return True

    def intersect(self, rays: Rays, stats: QueryStats, of_camera: bool) -> Intersections:
        """Nearest hits of camera rays, or of bounced rays; see ``Accelerator.intersect``.

        Here both are found alike; ``course.engine.terms.surfaces.surface`` clips camera rays.
        """
        arrays = rays.origin, rays.direction, stats, rays.time
        return self.accelerator.intersect(*arrays)

    def hits(
        self,
        found: Intersections,
        direction: Floats32,
        time: Floats32 | None = None,
        of_camera: bool = False,
    ) -> Hits:
        """Geometry and materials of the hits.

        Parameters
        ----------
        direction : (3, N) float32, unit vectors, of all rays of the batch
        time : (N,) float32 of all rays; None if nothing moves
        of_camera : true for camera rays
        """
        hits = self._find(found, direction)
        if time is None:
            return hits
        time = time if hits.ray is None else time.take(hits.ray)
        if isinstance(self.accelerator, MovingAccelerator):
            for points in (hits.p, hits.near_origin):
                self.accelerator.follow(points, hits.triangle, time)
        return replace(hits, time=time)

    def _find(self, found: Intersections, direction: Floats32) -> Hits:
        """The hits at time 0."""
        hit = np.flatnonzero(found.triangle >= 0)
        triangle, u, v, t = found.triangle, found.u, found.v, found.t
        ray: Indices | None = None
        if len(hit) < len(triangle):
            ray = hit
            triangle, u, v, t = triangle.take(hit), u.take(hit), v.take(hit), t.take(hit)
            direction = direction.take(hit, axis=1)
        triangles = self.triangles
        material = triangles.material.take(triangle)
        plane = gather(triangles.planes, triangle)
        corner, ng, offset, flat = plane[0:3], plane[3:6], plane[6], plane[7]

        # ---- points, by barycentrics: the error of origin + t * direction would grow with t
        edges = gather(triangles.edges, triangle)
        along_1, along_2, widest = edges[0:3], edges[3:6], edges[6]
        along_1 *= u
        along_2 *= v
        p = np.add(along_1, along_2, out=along_1)
        p += corner

        # ---- normals
        facing = dot(ng, direction)
        side = np.copysign(np.float32(1), -facing)
        ng *= side
        ns = ng
        if triangles.corner_normals is not None:
            # In many scenes most triangles are flat-shaded.
            some = np.flatnonzero(flat == 0)
            if len(some) == len(side):
                ns = self._interpolated(triangle, u, v, side, direction)
            else:
                ns = ng.copy()
                if len(some):
                    at = triangle.take(some), u.take(some), v.take(some), side.take(some)
                    ns[:, some] = self._interpolated(*at, direction.take(some, axis=1))
        near_origin = ng * offset
        near_origin += p
        pull_off_edges(triangles, near_origin, triangle, u, v, widest)
        return Hits(
            ray, triangle, u, v, t, material, direction, p, ng, ns, offset, near_origin, side
        )

    def _interpolated(
        self, triangle: Numbers, u: Floats32, v: Floats32, side: Floats32, direction: Floats32
    ) -> Floats32:
        """Shading normals (3, n) on the incoming side."""
        assert self.triangles.corner_normals is not None
        rows = gather(self.triangles.corner_normals, triangle)
        normal = rows[3:6]
        normal *= u
        rows[6:9] *= v
        normal += rows[6:9]
        normal += rows[0:3]
        # Opposite corner normals may cancel: `normalise` clamps the length.
        normalise(normal)
        normal *= side
        if self.turns_normals:
            turn_to_viewer(normal, direction)
        return normal


def turn_to_viewer(ns: Floats32, direction: Floats32) -> None:
    """Turn shading normals that face away from the viewer until they are orthogonal to the ray, in place."""
    away = dot(ns, direction)
    wrong = np.flatnonzero(away > 0)
    if len(wrong):
        d = direction.take(wrong, axis=1)
        turned = ns.take(wrong, axis=1)
        turned -= away.take(wrong) * d
        normalise(turned)
        ns[:, wrong] = turned
