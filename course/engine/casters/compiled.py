"""A hierarchy that Numba's loops build and follow, sixteen rays at a time."""

import numpy as np

from course.engine.casters import build_kernels, cast_kernels
from course.engine.core.accelerator import Intersections
from course.engine.core.types import Floats32, Mask, Numbers


class CompiledCaster:
    """See ``course.engine.core.accelerator.Caster``; vertices (V, 3) float32 and triangles (T, 3) int32, T > 0."""

    def __init__(self, vertices: Floats32, triangles: Numbers) -> None:
        self.memory: Floats32 = build_kernels.build(vertices, triangles)

    @property
    def scene(self) -> int:
        """Address of the hierarchy, in the place of an Embree scene's; good for as long as this object lives."""
        return self.memory.ctypes.data

    def nearest(self, origin: Floats32, direction: Floats32, limit: Floats32) -> Intersections:
        """See ``Caster``."""
        n = direction.shape[1]
        triangle, uvt = np.empty(n, np.int32), np.empty((3, n), np.float32)
        rays = map(np.ascontiguousarray, (origin, direction, limit))
        cast_kernels.nearest(self.memory, *rays, triangle, uvt)
        return Intersections(triangle, *uvt)

    def free(self, origin: Floats32, direction: Floats32, limit: Floats32 | float) -> Mask:
        """See ``Caster``."""
        free = np.empty(direction.shape[1], np.bool_)
        rays = map(np.ascontiguousarray, (origin, direction))
        limits = np.atleast_1d(np.asarray(limit, np.float32))
        cast_kernels.free(self.memory, *rays, limits, free)
        return free
