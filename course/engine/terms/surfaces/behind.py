"""The view of triangles from behind, for camera rays: normals turned to the rays, normals as they are, or nothing.

Rays that have left a surface meet all triangles alike, and so do shadow rays.
"""

from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from course.engine.core.accelerator import Accelerator, Intersections, QueryStats
from course.engine.core.hits import Hits
from course.engine.core.types import Floats32, Indices, Mask, Numbers
from course.engine.core.vectors import dot

Behind: TypeAlias = Literal["turned", "kept", "unseen"]

STEP = np.float32(2.0**-19)
"""A ray that goes on behind a triangle starts this far behind it, as a share of its way and of the scene's size."""


@dataclass(frozen=True)
class SeenThrough:
    """An accelerator for camera rays, which pass through the backs of some triangles.

    Attributes
    ----------
    accelerator : of all triangles, but for those that no camera ray meets from the front
    unseen : (T,) which triangles rays pass through from behind
    planes : (T, 8) float32 of ``course.engine.core.triangles.Triangles``
    """

    accelerator: Accelerator
    unseen: Mask
    planes: Floats32

    def intersect(
        self,
        origin: Floats32,
        direction: Floats32,
        stats: QueryStats,
        time: Floats32 | None = None,
    ) -> Intersections:
        """Nearest hits that are seen; see ``Accelerator.intersect``."""
        found = self.accelerator.intersect(origin, direction, stats, time)
        through = self._from_behind(found.triangle, direction)
        while len(through):
            way = direction.take(through, axis=1)
            start = found.t.take(through)
            start += STEP * (1 + start)
            begin = origin if origin.shape[1] == 1 else origin.take(through, axis=1)
            again = self.accelerator.intersect(
                begin + start * way, way, stats, None if time is None else time.take(through)
            )
            found.triangle[through], found.u[through], found.v[through] = (
                again.triangle,
                again.u,
                again.v,
            )
            found.t[through] = np.where(again.triangle < 0, again.t, again.t + start)
            through = through.take(self._from_behind(again.triangle, way))
        return found

    def _from_behind(self, triangle: Numbers, direction: Floats32) -> Indices:
        """Indices of the rays that hit the back of a triangle which they pass through."""
        met = np.flatnonzero(triangle >= 0)
        met = met.compress(self.unseen.take(triangle.take(met)))
        normal = self.planes[triangle.take(met), 3:6].T
        return met.compress(dot(normal, direction.take(met, axis=1)) > 0)


def keep_normals(kept: Mask, hits: Hits) -> None:
    """Turn hits from behind, whose normals look to the ray, back to how the triangles are, in place.

    Parameters
    ----------
    kept : (T,) of which triangles normals are kept
    hits : of camera rays
    """
    which = np.flatnonzero(kept.take(hits.triangle) & (hits.side < 0))
    if len(which) == 0:
        return
    ng, ns = hits.ng, hits.ns
    ng[:, which] *= -1
    if ns is not ng:
        ns[:, which] *= -1
    hits.side[which] = 1
    hits.near_origin[:, which] += ng[:, which] * (2 * hits.offset[which])
