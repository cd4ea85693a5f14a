"""Direct light by loops over hits."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from course.compiled import direct_kernels, light_kernels, shadow_kernels
from course.compiled.accelerator import MovingPackets, PacketAccelerator, SceneTables
from course.core.direct import ROUNDING, Candidates
from course.core.hits import Hits
from course.core.lights.sample import Light, Sample
from course.core.rays import Draws
from course.core.types import Floats32, Indices
from course.extras.direct import FullDirectLight
from course.extras.mesh_light import MeshLight

_NO_NORMAL = np.empty(0, np.float32)
_ALL_MATERIALS = np.empty((0, 0), np.bool_)
_NO_BULGE = np.empty((0, 3), np.float32)
_UNASKED, _UNASKED_MASK = np.empty(0, np.float32), np.empty(0, np.bool_)
_NO_COLUMNS = np.empty((3, 0), np.float32)


@dataclass(frozen=True)
class PointsOnLight(Sample):
    """Points on a light in the place of ``to_light``; the loop works out the rest, which is empty."""

    normal: Floats32
    two_sided: bool


def points_on_light(
    on_light: Floats32, _points: Floats32, normal: Floats32 | None = None, two_sided: bool = False
) -> PointsOnLight:
    """Stand in for ``course.core.lights.sample.towards``."""
    normal = _NO_NORMAL if normal is None else normal
    return PointsOnLight(on_light, _UNASKED, _UNASKED, normal, two_sided)


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

    def _from_lights(
        self, hits: Hits, path: Indices | None, depth: int, draws: Draws
    ) -> tuple[Floats32 | None, Floats32 | None]:
        """In one loop a light for what the camera sees."""
        accelerator = self.surface.accelerator
        # After a bounce neighbours go apart, and few face the light: to gather those that do makes fuller packets.
        several = depth or self.lifted or self.choice is not None
        # The loop takes all light that arrives to be the diffuse term's.
        several = several or (self.highlights is not None and self.highlights.covers is not None)
        if several or not isinstance(accelerator, PacketAccelerator | MovingPackets):
            return super()._from_lights(hits, path, depth, draws)
        diffuse: Floats32 | None = None
        specular: Floats32 | None = None
        for light in self.lights:
            u = draws(light.name, path, depth) if light.width else None
            irradiance, shiny = self._illuminate(accelerator.tables, light, hits, u, path, draws)
            if irradiance is None:
                continue
            added = irradiance * light.color[:, None]
            diffuse = added if diffuse is None else np.add(diffuse, added, out=diffuse)
            if shiny is not None:
                highlight = self._highlight(hits, shiny, shiny.irradiance)
                specular = self._accumulated(specular, hits, shiny, highlight, light.color)
        return diffuse, specular

    def _illuminate(
        self,
        scenes: SceneTables,
        light: Light,
        hits: Hits,
        u: Floats32 | None,
        path: Indices | None,
        draws: Draws,
    ) -> tuple[Floats32 | None, Candidates | None]:
        """Irradiance (n,) from a light, and what it reaches of materials with highlights; None for none."""
        points, triangles, n = self._points(hits, light), self.surface.triangles, hits.size
        sample = self._sample(light, points, u, points_on_light)
        irradiance, counts = np.empty(n, np.float32), np.zeros(4, np.int64)
        shiny = _UNASKED_MASK
        if self.specular is not None:
            shiny = np.asarray(self.specular.rows.any(axis=0))
        k = n if len(shiny) else 0
        which, towards = np.empty(k, np.int64), np.empty((6, k), np.float32)
        asked = _UNASKED_MASK if draws.costs is None else np.empty(n, np.bool_)
        arrays = hits.near_origin, points, hits.ns, hits.ng, hits.material, hits.side
        places = hits.triangle, hits.u, hits.v, sample.to_light
        time = _UNASKED if hits.time is None else np.ascontiguousarray(hits.time)
        shadow_kernels.illuminate(
            *(scenes.blockers, scenes.velocity, scenes.boxes, time),
            *map(np.ascontiguousarray, (*arrays, *places, sample.inverse_length, sample.factor)),
            *(
                (sample.normal, sample.two_sided)
                if isinstance(sample, PointsOnLight)
                else (_NO_NORMAL, False)
            ),
            _ALL_MATERIALS if self.shaded is None else self.shaded,
            _NO_BULGE if triangles.bulge is None else triangles.bulge,
            *(np.float32(triangles.largest_sine + ROUNDING), np.float32(light.limit)),
            *(shiny, irradiance, which, towards, asked, counts),
        )
        shadow, above, nanoseconds, k = counts.tolist()
        draws.counters.embree.seconds += 1e-9 * shadow_kernels.TIMED * nanoseconds
        draws.counters.rays["shadow"] += above
        draws.cast("shadow", shadow, path, np.flatnonzero(asked) if len(asked) else None)
        if shadow == 0:
            return None, None
        if k == 0:
            return irradiance, None
        which, towards = which[:k], towards[:, :k]
        return irradiance, Candidates(
            *(which, which, None, towards[0], towards[1], hits.near_origin),
            *(towards[3:], towards[2]),
        )

    def _sample(
        self,
        light: Light,
        points: Floats32,
        u: Floats32 | None,
        towards: Callable[..., Any] = towards,
    ) -> Any:
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
        values = self._under_facets(hits, candidates, values)
        direct_kernels.spread(candidates.index, *map(np.ascontiguousarray, (values, color)), total)
        return total

    def _reflected(self, hits: Hits, diffuse: Floats32, specular: Floats32 | None) -> Floats32:
        highlights = _NO_COLUMNS, _NO_COLUMNS
        specular = self._painted(hits, specular)
        if specular is not None and self.specular is not None:
            highlights = self.specular.rows, specular
        tint = _NO_COLUMNS if hits.tint is None else hits.tint
        arrays = hits.material, self.diffuse.rows, tint, *highlights
        direct_kernels.reflect(*map(np.ascontiguousarray, arrays), diffuse)
        return diffuse
