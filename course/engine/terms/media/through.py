"""Light that surfaces get through fog: what the direct light of a scene becomes where fog is in the way."""

from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np

from course.engine.core.accelerator import Intersections, QueryStats
from course.engine.core.direct import Candidates, DirectLight, Reflection, Sums
from course.engine.core.hits import Hits, Surface
from course.engine.core.lights.sample import TO_THE_LIGHT, Light
from course.engine.core.rays import Draws, Rays
from course.engine.core.types import Floats32, Indices, Mask
from course.engine.core.vectors import repeated
from course.engine.terms.environments.sky import Sky
from course.engine.terms.media.fog import NO_FOG, Fogs


class KnownHits:
    """A surface for one batch of rays whose hits are known."""

    def __init__(self, surface: Surface, found: Intersections) -> None:
        self._surface, self._found = surface, found

    def intersect(self, _rays: Rays, _stats: QueryStats, _of_camera: bool) -> Intersections:
        """See ``Surface``."""
        return self._found

    def __getattr__(self, name: str) -> Any:
        return getattr(self._surface, name)


@dataclass(frozen=True)
class FogReflection:
    """See ``Reflection``: what another one reflects of light that has come through fog.

    Attributes
    ----------
    endless : whether the light is infinitely far away
    """

    reflection: Reflection
    fogs: Fogs
    endless: bool

    def add(self, sums: Sums, hits: Hits, candidates: Candidates, color: Floats32) -> Sums:
        """See ``Reflection``."""
        n = candidates.origin.shape[1]
        toward = repeated(candidates.to_light * candidates.inverse_length, n)
        limit = np.float32(np.inf if self.endless else 1) / candidates.inverse_length
        limit = np.broadcast_to(limit, n)
        left = self.fogs.transmittance(candidates.of(hits.p), toward, limit)
        # Irradiance has one value for all channels: where they differ, each comes by itself.
        grey = (left[0] == left).all()
        channels = [(color, left[0])] if grey else list(zip(np.diag(color), left, strict=True))
        for some, share in channels:
            arriving = replace(candidates, irradiance=candidates.irradiance * share)
            sums = self.reflection.add(sums, hits, arriving, some)
        return sums

    def reflected(self, hits: Hits, sums: Sums) -> Floats32:
        """See ``Reflection``."""
        return self.reflection.reflected(hits, sums)


class _FarRays:
    """The surface and the environment of a sky for one batch: what it sees comes through fog.

    A sky asks which of its rays are free, and then for the radiance of these.
    """

    def __init__(self, sky: Sky, fogs: Fogs) -> None:
        self._sky, self._fogs = sky, fogs
        self._origin: Floats32 | None = None

    @property
    def accelerator(self) -> "_FarRays":
        """What answers rays."""
        return self

    def unoccluded(
        self,
        origin: Floats32,
        direction: Floats32,
        limit: float,
        stats: QueryStats,
        time: Floats32 | None = None,
    ) -> Mask:
        """See ``Accelerator.unoccluded``."""
        asked = self._sky.surface.accelerator.unoccluded(origin, direction, limit, stats, time)
        self._origin = origin[:, asked]
        return asked

    def radiance(self, direction: Floats32) -> Floats32:
        """See ``Environment.radiance``."""
        assert self._origin is not None
        limit = np.full(direction.shape[1], np.inf, np.float32)
        left = self._fogs.transmittance(self._origin, direction, limit)
        return np.asarray(self._sky.environment.radiance(direction) * left, np.float32)


@dataclass(frozen=True)
class FogSky(Sky):
    """An environment that lights surfaces through fog."""

    fogs: Fogs = NO_FOG

    def __call__(
        self, hits: Hits, path: Indices | None, depth: int, draws: Draws
    ) -> Floats32 | None:
        """See ``Sky``."""
        far: Any = _FarRays(self, self.fogs)
        known = {each.name: getattr(self, each.name) for each in fields(Sky)}
        known |= {"surface": far, "environment": far}
        return Sky(**known)(hits, path, depth, draws)


@dataclass(frozen=True)
class FogDirect(DirectLight):
    """See ``DirectLight``; ``fogs`` is what light comes through."""

    fogs: Fogs = NO_FOG

    def from_light(
        self,
        light: Light,
        sums: Sums,
        hits: Hits,
        path: Indices | None,
        depth: int,
        draws: Draws,
    ) -> Sums:
        """See ``DirectLight``."""
        endless = light.limit > TO_THE_LIGHT
        known = {each.name: getattr(self, each.name) for each in fields(DirectLight)}
        known["reflection"] = FogReflection(self.reflection, self.fogs, endless)
        return DirectLight(**known).from_light(light, sums, hits, path, depth, draws)


def through_fog(direct: DirectLight, fogs: Fogs) -> FogDirect:
    """Direct light of a scene with fog."""
    known = {each.name: getattr(direct, each.name) for each in fields(direct)}
    if isinstance(direct.sky, Sky):
        of_sky = {each.name: getattr(direct.sky, each.name) for each in fields(direct.sky)}
        known["sky"] = FogSky(**of_sky, fogs=fogs)
    return FogDirect(**known, fogs=fogs)
