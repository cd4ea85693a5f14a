"""Where rays meet the surface: points, normals and a safe place to leave from, for the rays that hit something."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from course.core.types import Floats32, Indices, Mask
from course.core.vectors import dot
from course.geometry.embree import Intersections
from course.geometry.surface import Surface


@dataclass(frozen=True)
class Hits:
    """The hits of a batch, one column a hit.

    Attributes
    ----------
    ray : (n,) index of the ray in its batch, or None when every ray hit something
    material : (n,) uint16
    p : (3, n) float32, the point
    direction : (3, n) float32, of the ray that came in
    ng, ns : (3, n) float32, unit geometric and shading normals, both on the incoming side
    above, below : (3, n) float32, where rays leave from on the incoming and on the far side
    raised : (3, n) float32, where shadow rays leave from: ``above`` plus the bulge of a smooth mesh
    entering : (n,) bool, the ray comes from outside (it looks at the front of the triangle)
    t : (n,) float32, distance along the ray
    """

    ray: Indices | None
    material: np.ndarray[tuple[int], np.dtype[np.uint16]]
    p: Floats32
    direction: Floats32
    ng: Floats32
    ns: Floats32
    above: Floats32
    raised: Floats32
    entering: Mask
    t: Floats32
    step: Floats32

    @property
    def below(self) -> Floats32:
        """Where refracted rays leave from: the same step to the far side."""
        return self.p - self.step

    @property
    def size(self) -> int:
        """Number of hits."""
        return self.p.shape[1]


def find_hits(surface: Surface, found: Intersections, direction: Floats32) -> Hits:
    """Everything that shading needs to know about the hits of a batch of rays.

    Parameters
    ----------
    direction : (3, N) float32, unit length, of all rays of the batch
    """
    hit = np.flatnonzero(found.triangle >= 0)
    triangle, u, v, t = found.triangle, found.u, found.v, found.t
    ray: Indices | None = None
    if len(hit) < len(triangle):
        ray = hit
        triangle, u, v, t = triangle.take(hit), u.take(hit), v.take(hit), t.take(hit)
        direction = direction.take(hit, axis=1)

    # From the corners, not origin + t * direction: its error is that of the triangle, however far the camera.
    corner = surface.corner_edges.take(triangle, axis=1)
    p = corner[3:6]
    p *= u
    edge = corner[6:9]
    edge *= v
    p += edge
    p += corner[0:3]

    normal = surface.normal_offset.take(triangle, axis=1)
    ng, offset = normal[:3], normal[3]
    facing = dot(ng, direction)
    entering = facing < 0
    side = np.copysign(np.float32(1), -facing)
    ng *= side
    step = ng * offset
    above = p + step

    ns, raised = ng, above
    if surface.corner_normals is not None and surface.bulge is not None:
        ns = _interpolated(surface.corner_normals.take(triangle, axis=1), u, v)
        ns *= side
        _turn_to_viewer(ns, direction)
        raised = above + ns * _bulge(surface.bulge.take(triangle, axis=1), u, v, side)
    return Hits(
        ray, surface.material.take(triangle), p, direction, ng, ns, above, raised, entering, t, step
    )


def _interpolated(rows: Floats32, u: Floats32, v: Floats32) -> Floats32:
    """Unit normals from rows n0, n1 - n0, n2 - n0."""
    normal = rows[3:6]
    normal *= u
    rows[6:9] *= v
    normal += rows[6:9]
    normal += rows[0:3]
    squared = dot(normal, normal)
    # Opposite corner normals may cancel; any unit vector is as good as another there.
    np.maximum(squared, np.float32(1e-20), out=squared)
    normal *= 1 / np.sqrt(squared)
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


def _bulge(k: Floats32, u: Floats32, v: Floats32, side: Floats32) -> Floats32:
    """Height of the round surface above the triangle on the incoming side, (n,); never below it."""
    w = 1 - u
    w -= v
    h = w * u
    h *= k[0]
    term = w
    term *= v
    term *= k[1]
    h += term
    term = u * v
    term *= k[2]
    h += term
    h *= side
    return np.maximum(h, 0, out=h)
