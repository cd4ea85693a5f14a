"""Hits found by one loop instead of forty passes."""

from dataclasses import dataclass

import numpy as np

from course.compiled import hit_kernels
from course.compiled.accelerator import PacketAccelerator
from course.compiled.convex import Objects
from course.core.accelerator import Intersections
from course.core.hits import Hits
from course.core.types import Floats32, Indices
from course.extras.surface import FullSurface

_ALL_RAYS = np.empty(0, np.int64)
_NOTHING_MET = np.empty(0, np.int32), np.empty((3, 0), np.float32), np.empty((3, 0), np.float32)
_NO_NORMALS = np.empty((3, 0), np.float32), np.empty((0, 9), np.float32)


@dataclass(frozen=True)
class CompiledSurface(FullSurface):
    """All triangles of a scene."""

    def _find(self, found: Intersections, direction: Floats32) -> Hits:
        triangles = self.triangles
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
        p, ng, near_origin = np.empty((3, 3, n), np.float32)
        offset, side = np.empty((2, n), np.float32)
        ns, corner_normals = _NO_NORMALS
        if triangles.corner_normals is not None:
            ns, corner_normals = np.empty((3, n), np.float32), triangles.corner_normals
        hit_kernels.find(
            *(_ALL_RAYS if ray is None else hit, *rays),
            *(triangles.planes, triangles.edges, triangles.inset, corner_normals),
            *(triangles.material, self.turns_normals, met, uvt, arriving),
            *(material, p, ng, ns, offset, near_origin, side),
        )
        ns = ng if triangles.corner_normals is None else ns
        return Hits(
            *(ray, triangle, u, v, t, material, direction, p, ng, ns, offset, near_origin, side)
        )

    def excluded_objects(self, hits: Hits, which: Indices, direction: Floats32) -> Objects | None:
        """The convex object that each of some rays leaves for good, (m,), -1 for none; None where nobody asks."""
        accelerator = self.accelerator
        if not isinstance(accelerator, PacketAccelerator) or accelerator.convex is None:
            return None
        excluded = np.empty(len(which), np.int8)
        arrays = which, hits.triangle, hits.side, hits.ng, direction
        table = accelerator.convex.first, accelerator.convex.worth
        hit_kernels.leave(*map(np.ascontiguousarray, arrays), *table, excluded)
        return excluded
