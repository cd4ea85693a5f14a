"""Lamps in lobes by loops over hits, where all that are combined are round and the functions are the course's own."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from course.compiled import direct_kernels, numpy_kernels
from course.core.direct import Candidates
from course.core.hits import Hits
from course.core.rays import Draws, Rays
from course.core.types import Floats32, Indices
from course.extras.lamps_and_lobes import (
    ALONE,
    LampsAndLobes,
    LobeLight,
    LobeRays,
    RoundLamp,
    left_by,
)
from course.extras.own import courses_own
from course.extras.plan import same_fields
from course.extras.scatter import FullScatter
from course.extras.visible_sphere import VisibleSphereLight

_ONE, _ALL = np.empty((3, 0), np.float32), np.empty(0, np.int64)


@dataclass(frozen=True)
class CompiledLampsAndLobes(LampsAndLobes):
    """Light that lobes reflect from points on round lamps, and the weights of what rays of lobes meet."""

    @cached_property
    def _lobes(self) -> Any:
        from course.compiled.lobe_kernels import Lobes

        combining, mirror = self.combining, np.ascontiguousarray(self.scatter.mirror.rows)
        arrays = np.ascontiguousarray(combining.exponents), combining.reach, mirror
        return Lobes(*arrays, int(combining.power or 0), ALONE)

    @cached_property
    def _balls(self) -> list[Any]:
        from course.compiled.lobe_kernels import Ball

        return [
            Ball(
                lamp.center,
                float(lamp.radius),
                np.float32(lamp.radius * lamp.radius),
                np.float32(np.pi / lamp.area),
            )
            for lamp in self.combining.lamps
            if isinstance(lamp, RoundLamp)
        ]

    def light(
        self, hits: Hits, beta: Floats32 | None, path: Indices | None, depth: int, draws: Draws
    ) -> Floats32 | None:
        """See ``LampsAndLobes``."""
        from course.compiled import lobe_kernels

        arrays = hits.near_origin, hits.direction, hits.ns, hits.ng, hits.material
        places = tuple(map(np.ascontiguousarray, arrays))
        beta = _ONE if beta is None else np.ascontiguousarray(beta)
        cutoff = np.float32(self.scatter.cutoff)
        total = None
        for stage, ball in zip(self.by_points, self._balls, strict=True):
            found = np.empty(hits.size, np.int64)
            k = lobe_kernels.ask(ball, self._lobes, *places, beta, cutoff, found)
            if k == 0:
                continue
            candidates = self._looked_for(stage, ball, places, found[:k], path, depth, draws)
            if candidates is None:
                continue
            total = np.zeros((3, hits.size), np.float32) if total is None else total
            self._add(stage, hits, candidates, path, draws, total)
        if total is not None:
            total *= self.scatter.mirror(hits.material)
        return total

    def _looked_for(
        self,
        stage: LobeLight,
        ball: Any,
        places: tuple[Any, ...],
        which: Indices,
        path: Indices | None,
        depth: int,
        draws: Draws,
    ) -> Candidates | None:
        """Shadow rays to points on a lamp from hits ``which`` (k,), which is overwritten."""
        from course.compiled import lobe_kernels

        assert stage.lamp is not None
        u = draws(stage.lamp.light.name, which if path is None else path.take(which), depth)
        light, cosine, near = np.empty((3, len(which)), np.float32)
        origin, to_light = np.empty((2, 3, len(which)), np.float32)
        filled = which, light, cosine, origin, to_light, near
        call = numpy_kernels.call_of()
        k = lobe_kernels.look(ball, self._lobes, *places, np.ascontiguousarray(u), call, *filled)
        if k == 0:
            return None
        parts: Any = (np.ascontiguousarray(each[..., :k]) for each in filled)
        which, light, cosine, origin, to_light, near = parts
        return Candidates(which, which, None, light, cosine, origin, to_light, near)

    def _add(
        self,
        stage: LobeLight,
        hits: Hits,
        candidates: Candidates,
        path: Indices | None,
        draws: Draws,
        total: Floats32,
    ) -> None:
        """Add what shadow rays bring that meet nothing."""
        assert stage.lamp is not None
        light = stage.lamp.light
        arriving = candidates.irradiance
        arriving *= stage._visible(light, hits, candidates, draws)
        draws.cast("shadow", len(candidates.index), path, candidates.index)
        direct_kernels.spread(candidates.index, arriving, light.color, total)

    def carried(self, hits: Hits, path: Indices | None, rays: Rays) -> Rays:
        """See ``LampsAndLobes``."""
        from course.compiled import lobe_kernels

        which = left_by(rays, path)
        density, peak = np.empty((2, rays.size), np.float32)
        arrays = which, rays.direction, hits.direction, hits.ns, hits.ng, hits.material
        exponents, call = self._lobes.exponents, numpy_kernels.call_of()
        lobe_kernels.carry(exponents, *map(np.ascontiguousarray, arrays), call, density, peak)
        known: dict[str, Any] = vars(rays)
        return LobeRays(**known, density=density, peak=peak)

    def share(self, rays: Rays, hits: Hits) -> Floats32 | None:
        """See ``LampsAndLobes``."""
        if not isinstance(rays, LobeRays) or rays.density is None or rays.peak is None:
            return None
        from course.compiled import lobe_kernels

        found = np.ones(hits.size, np.float32)
        ray = _ALL if hits.ray is None else hits.ray
        arrays = ray, hits.material, hits.side, rays.origin, rays.density, rays.peak
        places = tuple(map(np.ascontiguousarray, arrays))
        for lamp, ball in zip(self.combining.lamps, self._balls, strict=True):
            lobe_kernels.share(ball, self._lobes, lamp.material, *places, found)
        return found


def compiled_lamps_and_lobes(stage: LampsAndLobes) -> LampsAndLobes:
    """The stage by loops, where they know its lamps, and its functions are the course's own."""
    combining, functions, scatter = stage.combining, stage.combining.functions, stage.scatter
    plain = not isinstance(scatter, FullScatter) or scatter.conductors is None
    round_lamps = all(
        isinstance(lamp, RoundLamp) and type(lamp.light) is VisibleSphereLight
        for lamp in combining.lamps
    )
    plain = plain and not combining.metals
    if not (numpy_kernels.AVAILABLE and plain and round_lamps):
        return stage
    names = ["cone_density"] if combining.power is None else ["cone_density", "heuristic_weights"]
    if combining.power not in (None, 1, 2) or not all(
        courses_own(getattr(functions, name)) for name in names
    ):
        return stage
    return CompiledLampsAndLobes(**same_fields(stage))
