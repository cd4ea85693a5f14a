"""Direct light by loops over hits."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from course.compiled import direct_kernels, light_kernels
from course.core.direct import Candidates
from course.core.hits import Hits
from course.core.lights import Light, Sample
from course.core.materials import Lookup
from course.core.types import Floats32, Indices
from course.extras.direct import FullDirectLight
from course.extras.mesh_light import MeshLight

_NO_NORMAL = np.empty(0, np.float32)
_ALL_MATERIALS = np.empty((0, 0), np.bool_)


def towards(
    on_light: Floats32, points: Floats32, normal: Floats32 | None = None, two_sided: bool = False
) -> Sample:
    """See ``course.core.lights.sample.towards``."""
    sample = _empty_sample(points.shape[1])
    light_kernels.towards(
        *map(np.ascontiguousarray, (on_light, points, _NO_NORMAL if normal is None else normal)),
        two_sided,
        *(sample.to_light, sample.inverse_length, sample.factor),
    )
    return sample


def _empty_sample(n: int) -> Sample:
    return Sample(np.empty((3, n), np.float32), *np.empty((2, n), np.float32))


def on_triangles(light: MeshLight, points: Floats32, u: Floats32) -> Sample:
    """See ``MeshLight.sample``."""
    groups, sample = light.groups, _empty_sample(points.shape[1])
    light_kernels.on_triangles(
        *map(np.ascontiguousarray, (points, u)),
        *(groups.moments, groups.trust, groups.share, groups.start, groups.last),
        *(groups.shares, groups.triangle, light.planes, light.edges),
        *(sample.to_light, sample.inverse_length, sample.factor),
    )
    return sample


@dataclass(frozen=True)
class CompiledDirectLight(FullDirectLight):
    """What lights and the environment make visible at hits."""

    def _sample(self, light: Light, points: Floats32, u: Floats32 | None) -> Sample:
        if isinstance(light, MeshLight) and u is not None:
            return on_triangles(light, points, u)
        return light.sample(points, u, towards)

    def _candidates(self, hits: Hits, sample: Sample) -> Candidates | None:
        """In two loops, which always gather."""
        n = hits.size
        index = np.empty(n, np.int64)
        irradiance, cosine = np.empty(n, np.float32), np.empty(n, np.float32)
        to_light = np.ascontiguousarray(sample.to_light)
        inverse_length = np.ascontiguousarray(sample.inverse_length)
        found = direct_kernels.facing(
            *map(np.ascontiguousarray, (hits.ns, hits.material, hits.side)),
            *(to_light, inverse_length, np.ascontiguousarray(sample.factor)),
            *(_ALL_MATERIALS if self.shaded is None else self.shaded, index, irradiance, cosine),
        )
        if found == 0:
            return None
        origin = hits.near_origin
        if found == n:
            return Candidates(
                index, None, None, irradiance, cosine, origin, to_light, inverse_length
            )
        index, irradiance, cosine = index[:found], irradiance[:found], cosine[:found]
        origin = np.empty((3, found), np.float32)
        there, near = np.empty((3, 0), np.float32), inverse_length[:0]
        if to_light.shape[1] > 1:
            there, near = np.empty((3, found), np.float32), np.empty(found, np.float32)
        direct_kernels.gather(
            index,
            np.ascontiguousarray(hits.near_origin),
            to_light,
            inverse_length,
            origin,
            there,
            near,
        )
        if to_light.shape[1] > 1:
            to_light, inverse_length = there, near
        return Candidates(index, index, None, irradiance, cosine, origin, to_light, inverse_length)

    def _turned_away(
        self, hits: Hits, candidates: Candidates, to_light: Floats32, most: np.float32
    ) -> Indices:
        found = np.empty(len(candidates.index), np.int64)
        arrays = candidates.index, candidates.cosine, hits.ng, to_light
        return found[: direct_kernels.turned(*map(np.ascontiguousarray, arrays), most, found)]

    def _accumulated(
        self,
        total: Floats32 | None,
        hits: Hits,
        candidates: Candidates,
        values: Floats32,
        color: Floats32,
    ) -> Floats32:
        if total is None:
            total = np.zeros((3, hits.size), np.float32)
        direct_kernels.spread(candidates.index, *map(np.ascontiguousarray, (values, color)), total)
        return total

    def _scale(self, total: Floats32, hits: Hits, lookup: Lookup) -> None:
        direct_kernels.scale(total, np.ascontiguousarray(hits.material), lookup.rows)
