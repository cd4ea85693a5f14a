"""Scattering by loops over hits."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from course.compiled import hit_kernels, scatter_kernels
from course.core.hits import Hits
from course.core.rays import Draws
from course.core.scatter import Boundary, Scatter
from course.core.types import Floats32, Indices, Mask
from course.extras.path_bounce import DIFFUSE, PathBounce
from course.extras.scatter import FullScatter

_ALL, _NONE = np.ones((3, 1), np.float32), np.empty(0, np.float32)


def origins(hits: Hits, which: Indices, near: int, after: Floats32) -> tuple[Floats32, Floats32]:
    """See ``Scatter.origins``."""
    origin, throughput = np.empty((2, 3, len(which)), np.float32)
    arrays = hits.near_origin, hits.p, hits.ng, hits.offset, after
    scatter_kernels.leave(which, near, *map(np.ascontiguousarray, arrays), origin, throughput)
    return origin, throughput


@dataclass(frozen=True)
class CompiledScatter(FullScatter):
    """Sends rays on that mirror or refract."""

    def boundary(
        self, hits: Hits, which: Indices | None, path: Indices | None, depth: int, draws: Draws
    ) -> Boundary:
        """See ``Scatter``."""
        if self.rough or self.microfacets or self.index is None:
            return super().boundary(hits, which, path, depth, draws)
        if which is None:
            which = np.arange(hits.size)
        reflected, passed, cos_i, cos_t, eta = (np.empty(len(which), np.float32) for _ in range(5))
        arrays = hits.material, hits.side, hits.direction, hits.ns, self.index.rows
        scatter_kernels.divide(
            which, *map(np.ascontiguousarray, arrays), reflected, passed, cos_i, cos_t, eta
        )
        return Boundary(reflected, passed, cos_i, cos_t, eta)

    def _mirror_images(self, hits: Hits, which: Indices, ng: Floats32) -> Floats32:
        if self.keeps:
            return super()._mirror_images(hits, which, ng)
        way = np.empty(ng.shape, np.float32)
        arrays = map(np.ascontiguousarray, (hits.direction, hits.ns, ng))
        hit_kernels.mirror(np.ascontiguousarray(which, np.int64), *arrays, way)
        return way

    def refracted(
        self,
        hits: Hits,
        which: Indices,
        boundary: Boundary,
        path: Indices,
        depth: int,
        draws: Draws,
    ) -> Floats32:
        """See ``Scatter``."""
        if self.rough or self.microfacets or self.keeps:
            return super().refracted(hits, which, boundary, path, depth, draws)
        way = np.empty((3, len(which)), np.float32)
        arrays = hits.direction, hits.ns, hits.ng, boundary.cos_i, boundary.cos_t, boundary.eta
        scatter_kernels.refract(which, *map(np.ascontiguousarray, arrays), way)
        return way

    def origins(
        self, hits: Hits, which: Indices, near: int, after: Floats32
    ) -> tuple[Floats32, Floats32]:
        """See ``Scatter``."""
        return origins(hits, which, near, after)


@dataclass(frozen=True)
class CompiledPathBounce(PathBounce):
    """Sends the paths of one depth on."""

    def _origins(
        self, hits: Hits, which: Indices, near: int, after: Floats32
    ) -> tuple[Floats32, Floats32]:
        return origins(hits, which, near, after)

    def _chosen(
        self,
        scatter: Scatter,
        hits: Hits,
        beta: Floats32 | None,
        diffuse: Floats32,
        other: Indices,
        boundary: Boundary | None,
        u: Floats32,
    ) -> tuple[Floats32, NDArray[np.int8]]:
        mirror = scatter.reflectance(hits, other)
        after = np.array(diffuse, np.float32)
        kind = np.full(hits.size, DIFFUSE, np.int8)
        shares = (_NONE, _NONE) if boundary is None else (boundary.reflected, boundary.refracted)
        arrays = (_ALL if beta is None else beta, mirror, *shares, u)
        scatter_kernels.choose(other, *map(np.ascontiguousarray, arrays), after, kind)
        return after, kind

    def _ordered(self, goes_on: Mask, kind: NDArray[np.int8] | None) -> tuple[Indices, int, int]:
        if kind is None:
            return super()._ordered(goes_on, kind)
        which, counts = np.empty(len(kind) + 1, np.int64), np.empty(3, np.int64)
        total = scatter_kernels.sort(np.ascontiguousarray(goes_on), kind, which, counts)
        return which[:total], int(counts[0]), int(counts[0] + counts[1])
