"""Fog in the distribution ray tracer: light that is scattered once on its way to the eye.

On each ray one place is chosen for each lamp (Kulla and Fajardo, "Importance sampling techniques for path tracing in
participating media", 2012), and a shadow ray asks whether the lamp is seen from there. What is behind fog is dimmed.
"""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from course.engine.core.accelerator import Intersections
from course.engine.core.hits import Hits
from course.engine.core.integrator import Integrator
from course.engine.core.rays import Draws, Rays
from course.engine.core.types import Floats32, Indices, Mask, Media
from course.engine.core.vectors import dot, repeated
from course.engine.terms.media.fog import NO_FOG, Fog, Fogs
from course.engine.terms.media.lamps import WAY, ArrivingLight, Lamps
from course.engine.terms.media.through import KnownHits
from course.engine.terms.media.watched import begun, numbered, tell

PLACE = ("fog place", 1)
"""The number of the place on a ray."""

NO_EXTINCTION = np.zeros(3, np.float32)


@dataclass(frozen=True)
class FogIntegrator(Integrator):
    """See ``Integrator``; rays come through fog, and bring light that it scatters."""

    fogs: Fogs = NO_FOG
    lamps: Lamps | None = None

    def intersect(
        self,
        rays: Rays,
        adds_lights: Mask | bool,
        depth: int,
        path_radiance: Floats32,
        draws: Draws,
    ) -> tuple[Hits, Floats32 | None, Indices | None, Media | None]:
        """See ``Integrator``."""
        rays, found = self._dimmed(rays, depth, path_radiance, draws)
        known: Any = KnownHits(self.surface, found)
        asked = rays, adds_lights, depth, path_radiance, begun(draws)
        return Integrator.intersect(replace(self, surface=known), *asked)

    def _dimmed(
        self, rays: Rays, depth: int, path_radiance: Floats32, draws: Draws
    ) -> tuple[Rays, Intersections]:
        """Rays that carry what fog lets through, and what they hit; what fog scatters is added."""
        rays = numbered(rays, depth, draws)
        assert rays.path is not None
        path = rays.path
        origin = repeated(rays.origin, rays.size)
        found = self.surface.intersect(rays, draws.counters.embree, depth == 0)
        limit = np.where(found.triangle < 0, np.float32(np.inf), found.t)
        carried = rays.throughput
        if carried is None:
            carried = np.ones((3, rays.size), np.float32)
        left = self.fogs.transmittance(origin, rays.direction, limit)
        # Told to watchers is what comes before the ray's own throughput at its end.
        told = np.where(np.isinf(limit), np.float32(1), left)
        for fog in self.fogs.all:
            start, length = fog.span(origin, rays.direction, limit)
            which = np.flatnonzero(length > 0)
            if len(which) and fog.scattering.any() and self.lamps is not None:
                some = _Stretch(
                    self.fogs,
                    fog,
                    origin.take(which, axis=1),
                    rays.direction.take(which, axis=1),
                    start.take(which),
                    length.take(which),
                    path.take(which),
                    None if rays.time is None else rays.time.take(which),
                    carried.take(which, axis=1),
                    told.take(which, axis=1),
                )
                some.scatter(self, self.lamps, depth, path_radiance, draws)
        draws.counters.lap("fog")
        return replace(rays, throughput=carried * left), found


@dataclass(frozen=True)
class _Stretch:
    """Where some rays are in a box of fog."""

    fogs: Fogs
    fog: Fog
    origin: Floats32
    direction: Floats32
    start: Floats32
    length: Floats32
    path: Indices
    time: Floats32 | None
    carried: Floats32
    told: Floats32

    def scatter(
        self, integrator: Integrator, lamps: Lamps, depth: int, total: Floats32, draws: Draws
    ) -> None:
        """Add the light of all lamps that is scattered into the rays."""
        fog = self.fog
        u = draws(PLACE[0], self.path, depth)[0]
        entry = self.origin + self.start * self.direction
        for light, which, of_light, counts in lamps.asked(self.path, depth, draws):
            some = self._of(which)
            at, number = entry.take(which, axis=1), u.take(which)
            on_light = lamps.place_of(light, at, of_light, some.time)
            if on_light is None:
                distance, density = some.by_loss(number)
            else:
                rays = at, some.direction, on_light, some.length
                distance, density = fog.media.equiangular(*rays, number)
            points = at + distance * some.direction
            lit = lamps.lit(light, points, of_light, some.time, some.path, draws)
            some.add(
                integrator, lit, points, distance, density * np.float32(1 / counts), total, draws
            )
        distance, density = self.by_loss(u)
        if lamps.environment is not None:
            points = entry + distance * self.direction
            v = draws(WAY[0], self.path, depth)
            toward, odds = fog.media.sample_henyey_greenstein(self.direction, fog.g, v)
            sky = lamps.sky(points, toward, self.time, self.path, draws)
            if sky is not None:
                self.add(integrator, sky, points, distance, density * odds, total, draws)

    def by_loss(self, u: Floats32) -> tuple[Floats32, Floats32]:
        """Distances (n,) as dense as the mean channel loses light, and their density."""
        mean = np.float64(max(self.fog.extinction.mean(), 1e-30))
        all_of_it = -np.expm1(-mean * self.length.astype(np.float64))
        distance = np.minimum(-np.log1p(-u * all_of_it) / mean, self.length)
        density = mean * np.exp(-mean * distance) / np.maximum(all_of_it, 1e-300)
        return distance.astype(np.float32), density.astype(np.float32)

    def add(
        self,
        integrator: Integrator,
        lit: ArrivingLight,
        points: Floats32,
        distance: Floats32,
        density: Floats32,
        total: Floats32,
        draws: Draws,
    ) -> None:
        """Add what comes to points (3, n) at distances (n,) in the box, chosen with a density (n,)."""
        if not len(lit.which):
            tell(draws, lit, points, self.path, None)
            return
        everywhere, some, fog = points, self._of(lit.which), self.fog
        points, distance = points.take(lit.which, axis=1), distance.take(lit.which)
        entry = some.origin + some.start * some.direction
        phase = fog.media.henyey_greenstein(dot(lit.toward, some.direction), fog.g)
        beyond = fog.span(points, lit.toward, lit.distance)[1]
        lost = fog.extinction if fog.grid is None else NO_EXTINCTION
        ways = distance, beyond, phase, density.take(lit.which)
        radiance = fog.media.in_scattering(fog.scattering, lost, *ways) * lit.radiance
        if fog.grid is not None:
            radiance *= fog.density_at(points)
            radiance *= fog.transmittance(entry, some.direction, distance)
            radiance *= fog.transmittance(points, lit.toward, lit.distance)
        others = Fogs(tuple(each for each in self.fogs.all if each is not fog))
        radiance *= others.transmittance(some.origin, some.direction, some.start + distance)
        radiance *= others.transmittance(points, lit.toward, lit.distance)
        if draws.watcher is not None:
            shown = np.divide(radiance, some.told, out=np.zeros_like(radiance), where=some.told > 0)
            tell(draws, lit, everywhere, self.path, shown)
        integrator.add_radiance(total, some.path, radiance, some.carried)

    def _of(self, which: Indices) -> "_Stretch":
        """Some of the rays."""
        if len(which) == len(self.path):
            return self
        return _Stretch(
            self.fogs,
            self.fog,
            self.origin.take(which, axis=1),
            self.direction.take(which, axis=1),
            self.start.take(which),
            self.length.take(which),
            self.path.take(which),
            None if self.time is None else self.time.take(which),
            self.carried.take(which, axis=1),
            self.told.take(which, axis=1),
        )
