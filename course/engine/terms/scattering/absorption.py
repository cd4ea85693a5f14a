"""Absorption in dielectrics by Beer's law."""

from dataclasses import dataclass

import numpy as np

from course.engine.core.camera import Camera
from course.engine.core.hits import Hits
from course.engine.core.materials import Lookup, MaterialTable
from course.engine.core.rays import OPEN, Rays
from course.engine.core.types import Floats32, Indices, Mask, Media
from course.engine.core.vectors import dot
from course.engine.terms.cameras.near_plane import NearPlaneCamera

_LEAST = np.float32(1e-20)


@dataclass(frozen=True)
class Absorption:
    """Attenuates rays by exp(-absorption length).

    Attributes
    ----------
    coefficient : (3, M) [1 / unit of the compiled scene]
    dielectric : (M,) bool
    outside : (M,) material around each dielectric, -1 for vacuum; None if vacuum is around all
    camera : if it has a near plane, its rays start there, but are absorbed from the eye on
    """

    coefficient: Lookup
    dielectric: Mask
    outside: Media | None
    camera: Camera

    @classmethod
    def of(cls, materials: MaterialTable, camera: Camera) -> "Absorption":
        """The absorption of all dielectrics."""
        return cls(Lookup(materials.absorption), materials.refracts, materials.outside, camera)

    def __call__(
        self,
        rays: Rays,
        hits: Hits,
        throughput: Floats32 | None,
        medium: Media | None,
        of_camera: bool,
    ) -> Floats32 | None:
        """Throughput (3, n) of the rays at their hits; None for 1.

        A ray that hits the back of a dielectric came through it, whatever medium the ray carries: the camera may be
        inside. A ray that hits its front came through the material around it. If that is vacuum, or the surface is
        opaque, the ray came through the medium that it carries. throughput and medium are those of the rays that hit.
        """
        dielectric = self.dielectric.take(hits.material)
        through = np.where(~hits.entering & dielectric, hits.material.astype(np.int16), OPEN)
        if self.outside is not None:
            through = np.where(hits.entering, self.outside.take(hits.material), through)
        if medium is not None:
            through = np.where(through < 0, medium, through)
        which = np.flatnonzero(through >= 0)
        if len(which) == 0:
            return throughput
        length = _lengths(rays, hits, which)
        if of_camera and isinstance(self.camera, NearPlaneCamera):
            length = length + self.camera.distance_to_plane(hits.direction).take(which)
        transmittance = np.exp(-self.coefficient(through.take(which)) * length)
        result = np.ones((3, hits.size), np.float32) if throughput is None else throughput.copy()
        result[:, which] *= transmittance
        return result


def _lengths(rays: Rays, hits: Hits, which: Indices) -> Floats32:
    """Distances (m,) to the given hits from the points that the rays left: the previous hits, not the offset origins.

    Both distances end at the plane of the triangle that is hit. Their difference is clamped to the ray's length: a ray
    nearly parallel to the plane would make it arbitrarily large. ``rays`` are all of the batch, hit or not.
    """
    length: Floats32 = hits.t.take(which)
    if rays.start is None:
        return length
    ray = which if hits.ray is None else hits.ray.take(which)
    ng, direction = hits.ng.take(which, axis=1), hits.direction.take(which, axis=1)
    beside = rays.origin.take(ray, axis=1) - rays.start.take(ray, axis=1)
    # Negative: ng is on the incoming side.
    facing = np.minimum(dot(ng, direction), -_LEAST)
    return length + np.clip(dot(ng, beside) / facing, -length, length)
