"""What camera rays see of triangles from behind: normals turned to the rays, normals as they are, or nothing.

Rays that have left a surface meet all triangles alike, and so do shadow rays.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from course.core.types import Floats32, Indices, Mask, Numbers
from course.core.vectors import dot
from course.geometry.accelerators import AnyAccelerator
from course.geometry.convex import Extent, Objects
from course.geometry.embree import Accelerator, Intersections, QueryTime

Behind: TypeAlias = Literal["turned", "kept", "unseen"]

STEP = np.float32(2.0**-19)
"""A ray that goes on behind a triangle starts this far behind it, as a share of its way and of the scene's size."""


class FrontAccelerator(Accelerator):
    """Triangles, and beside them those that an eye sees which stands in one place.

    Parameters
    ----------
    vertices, triangles, extents : as ``Accelerator`` has them
    hidden : (T,) which of them the eye looks through; they keep their numbers

    Attributes
    ----------
    front : the others
    """

    def __init__(
        self, vertices: Floats32, triangles: Numbers, extents: Sequence[Extent], hidden: Mask
    ) -> None:
        super().__init__(vertices, triangles, extents)
        # Triangles that are a point: no ray meets them.
        self.front = Accelerator(vertices, np.where(hidden[:, None], triangles[:, :1], triangles))

    def use_packets(self, wanted: bool) -> None:
        """See ``Accelerator.use_packets``."""
        super().use_packets(wanted)
        self.front.use_packets(wanted)


@dataclass(frozen=True)
class SeenThrough:
    """What camera rays meet where they pass through some triangles from behind.

    Attributes
    ----------
    accelerator : of all triangles, but for those that no camera ray meets from the front
    unseen : (T,) which triangles rays pass through from behind
    planes : (T, 8) float32 of ``course.geometry.surface.Surface``
    """

    accelerator: AnyAccelerator
    unseen: Mask
    planes: Floats32

    def intersect(
        self,
        origin: Floats32,
        direction: Floats32,
        clock: QueryTime,
        time: Floats32 | None,
        *,
        coherent: bool = False,
        left: Objects | None = None,
    ) -> Intersections:
        """Nearest hits that are seen; see ``AnyAccelerator.intersect``."""
        found = self.accelerator.intersect(
            origin, direction, clock, time, coherent=coherent, left=left
        )
        through = self._from_behind(found.triangle, direction)
        while len(through):
            way = direction.take(through, axis=1)
            start = found.t.take(through)
            start += STEP * (1 + start)
            begin = origin if origin.shape[1] == 1 else origin.take(through, axis=1)
            again = self.accelerator.intersect(
                begin + start * way, way, clock, None if time is None else time.take(through)
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
        """Which of some rays have met the back of a triangle that they pass through."""
        met = np.flatnonzero(triangle >= 0)
        met = met.compress(self.unseen.take(triangle.take(met)))
        normal = self.planes[triangle.take(met), 3:6].T
        return met.compress(dot(normal, direction.take(met, axis=1)) > 0)


def keep_normals(
    kept: Mask,
    triangle: Numbers,
    side: Floats32,
    p: Floats32,
    ng: Floats32,
    ns: Floats32,
    offset: Floats32,
    above: Floats32,
) -> None:
    """Turn hits from behind, whose normals look to the ray, back to how the triangles are, in place.

    Parameters
    ----------
    kept : (T,) of which triangles normals are kept
    triangle, side, p, ng, ns, offset, above : of ``course.geometry.hits.Hits``, of camera rays
    """
    which = np.flatnonzero(kept.take(triangle) & (side < 0))
    if len(which) == 0:
        return
    ng[:, which] *= -1
    if ns is not ng:
        ns[:, which] *= -1
    side[which] = 1
    above[:, which] = p[:, which] + ng[:, which] * offset[which]
