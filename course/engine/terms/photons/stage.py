"""Caustics beside direct light: photons of progressive passes, a pass for each few samples of a pixel.

C. Knaus and M. Zwicker, "Progressive photon mapping: a probabilistic approach", 2011. The picture is the mean over
samples, and so over passes. A pass hangs on the seed and on its number alone, not on who asks for it first.
"""

from collections.abc import Callable
from dataclasses import dataclass, fields, replace

import numpy as np

from course.engine.core.direct import DirectLight, Reflection
from course.engine.core.hits import Hits
from course.engine.core.integrator import CancelledError, Integrator
from course.engine.core.materials import Lookup
from course.engine.core.motion import Motion
from course.engine.core.rays import Draws, Rays
from course.engine.core.types import Floats32, Functions, Indices, Mask
from course.engine.terms.paths.path_tracing import PathIntegrator
from course.engine.terms.photons.emission import Lamp, Target, matte
from course.engine.terms.photons.flight import CHOICE, Flight, at_rest
from course.engine.terms.photons.gathering import GATHER, Gathering
from course.engine.terms.photons.maps import Estimate, Maps, PhotonMap
from course.engine.terms.photons.passes import Passes
from course.engine.terms.photons.watched import paths_of, tell, unheard

SHARE = 20
"""Radii of the first pass in that of the ball that photons are sent to, where a scene says none."""


@dataclass(frozen=True)
class PhotonSettings:
    """What a scene asks for.

    Attributes
    ----------
    count : photons of a pass
    radius : of the first pass, in units of the compiled scene; None for a share of the target's
    samples : of a pixel that share a pass
    gather : rays of each hit that gather; 0 for caustics alone
    """

    count: int
    radius: float | None
    alpha: float
    estimate: Estimate
    samples: int
    gather: int


@dataclass(frozen=True)
class PhotonStage:
    """See ``Wrap`` in ``course.engine.terms.world``.

    Attributes
    ----------
    diffuses, refracts : (M,) which materials have a diffuse term, and which are glass
    albedo : (3, M) of the diffuse terms
    glow : (3, M) radiance of surfaces that no light samples; None if nothing else shines
    target : around all mirrors and glass; None where there are none
    everything : around the scene
    """

    settings: PhotonSettings
    lights: tuple[Lamp, ...]
    motion: Motion | None
    diffuses: Mask
    refracts: Mask
    albedo: Lookup
    glow: Lookup | None
    target: Target | None
    everything: Target
    module: Functions
    where: str

    def numbers(self, paths: bool) -> list[tuple[str, int]]:
        """See ``Wrap``: without rays that gather, what comes from the eye draws none."""
        del paths
        return [GATHER, CHOICE] if self.settings.gather else []

    def around(self, integrator: Integrator, max_depth: int) -> Integrator:
        """See ``Wrap``."""
        if integrator.direct is None:
            return integrator
        maps = Maps()
        direct = self._caustics(integrator, integrator.direct, max_depth, maps)
        direct = self._gathering(integrator, direct, max_depth, maps)
        if not isinstance(integrator, PathIntegrator):
            return replace(integrator, direct=direct)
        same = {each.name: getattr(integrator, each.name) for each in fields(integrator)}
        return PhotonPathIntegrator(**same | {"direct": direct})

    def _caustics(
        self, integrator: Integrator, direct: DirectLight, max_depth: int, maps: Maps
    ) -> DirectLight:
        """Direct light with caustics."""
        if self.target is None or integrator.scatter is None:
            return direct
        flight = self._flight(integrator, max_depth)
        passes = self._passes(flight, self.target, maps, False)
        return replace(direct, sky=Caustics(self, passes, direct.reflection, direct.sky))

    def _gathering(
        self, integrator: Integrator, direct: DirectLight, max_depth: int, maps: Maps
    ) -> DirectLight:
        """Direct light with what is gathered."""
        if not self.settings.gather or not max_depth:
            return direct
        # Where rays land it is one bounce less.
        flight, passes = self._flight(integrator, max_depth - 1), None
        if flight.bounces:
            sent_on = replace(flight, albedo=self.albedo)
            passes = self._passes(sent_on, self.everything, maps, True)
        known = {each.name: getattr(integrator, each.name) for each in fields(Integrator)}
        shading = Integrator(**known | {"emission": None, "glow": self.glow})
        gathering = Gathering(
            direct.sky,
            shading,
            direct.reflection,
            flight,
            passes,
            self.settings.samples,
            self.settings.estimate,
            self.settings.gather,
            max_depth,
            self.module,
        )
        return replace(direct, sky=gathering)

    def _flight(self, integrator: Integrator, bounces: int) -> Flight:
        scatter = integrator.scatter
        scatter = None if scatter is None else replace(scatter, cutoff=0.0)
        materials = self.diffuses, self.refracts
        known = integrator.surface, scatter, integrator.absorption, *materials
        return Flight(*known, bounces, self.module)

    def _passes(self, flight: Flight, target: Target, maps: Maps, indirect: bool) -> Passes:
        asked = self.settings
        radius = target.radius / SHARE if asked.radius is None else asked.radius
        known = asked.count, radius, asked.alpha, indirect, self.module, self.where, maps
        return Passes(self.lights, self.motion, target, flight, *known)


@dataclass(frozen=True)
class Caustics:
    """What photons bring to hits, beside what the environment does.

    ``sky`` : of ``DirectLight``, None if there is none
    """

    stage: PhotonStage
    passes: Passes
    reflection: Reflection
    sky: Callable[[Hits, Indices | None, int, Draws], Floats32 | None] | None

    def __call__(
        self, hits: Hits, path: Indices | None, depth: int, draws: Draws
    ) -> Floats32 | None:
        """Irradiance over pi (3, n), or None for 0; see ``DirectLight.sky``."""
        light = None if self.sky is None else self.sky(hits, path, depth, draws)
        draws.counters.lap("shade")
        shows = np.flatnonzero(matte(self.stage.diffuses, self.stage.refracts, hits))
        block, settings = draws.block, self.stage.settings
        paths = shows if path is None else paths_of(draws, path.take(shows))
        number = (block.first + paths % block.samples) // settings.samples
        for each in np.unique(number).tolist():
            if draws.cancelled():
                raise CancelledError
            some = shows.compress(number == each)
            points, normal = (
                at_rest(self.passes.flight.surface, hits, some),
                hits.ng.take(some, axis=1),
            )
            with unheard(draws):
                photons = self.passes.of(each, draws)
                asked = points, normal, self.stage.module, settings.estimate
                lit, found = photons.irradiance(*asked)
            if len(lit):
                if light is None:
                    light = np.zeros((3, hits.size), np.float32)
                own = np.zeros((3, hits.size), np.float32)
                own[:, some.take(lit)] = found * np.float32(1 / np.pi)
                light += own
                if draws.watcher is not None and path is not None:
                    self._tell(draws, photons, hits, path, some, points, normal, lit, own)
        draws.counters.lap("photons")
        return light

    def _tell(
        self,
        draws: Draws,
        photons: PhotonMap,
        hits: Hits,
        path: Indices,
        some: Indices,
        points: Floats32,
        normal: Floats32,
        lit: Indices,
        light: Floats32,
    ) -> None:
        shown = self.reflection.reflected(hits, (light.copy(), None))
        some = some.take(lit)
        with unheard(draws):
            asked = points, normal, lit, self.stage.module, self.stage.settings.estimate
            near = photons.pairs(*asked)
        places = hits.p.take(some, axis=1)
        away = self.passes.target.radius
        tell(draws, photons, near, path.take(some), places, shown.take(some, axis=1), away)


@dataclass(frozen=True)
class PhotonPathIntegrator(PathIntegrator):
    """See ``PathIntegrator``; light that comes to a diffuse surface by mirrors and glass alone is left to photons."""

    def step(
        self,
        rays: Rays,
        adds_lights: Mask | None,
        depth: int,
        path_radiance: Floats32,
        draws: Draws,
    ) -> tuple[Rays, Mask | None] | None:
        """See ``PathIntegrator``."""
        following = super().step(rays, adds_lights, depth, path_radiance, draws)
        if following is None or following[1] is None:
            return following
        # A path that has left a diffuse surface adds no lamp any more, though it meets it by a mirror.
        counts = np.zeros(draws.block.size, np.bool_)
        if adds_lights is not None:
            counts[slice(None) if rays.path is None else paths_of(draws, rays.path)] = adds_lights
        rest, mask = following
        assert rest.path is not None
        assert mask is not None
        return rest, mask & counts.take(paths_of(draws, rest.path))
