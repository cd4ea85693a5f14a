"""Fog in paths: light that is scattered any number of times.

Before a ray comes to a surface, a flight in each box of fog may end. There all lamps are asked for their light, and the
path goes on in a direction that the phase function chooses.
"""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from course.engine.core.accelerator import Intersections
from course.engine.core.hits import Hits
from course.engine.core.integrator import Integrator
from course.engine.core.rays import OPEN, Draws, Rays
from course.engine.core.types import Floats32, Indices, Mask, Media
from course.engine.core.vectors import dot, repeated
from course.engine.terms.media.fog import NO_FOG, Fogs
from course.engine.terms.media.lamps import WAY, ArrivingLight, Lamps
from course.engine.terms.media.through import KnownHits
from course.engine.terms.media.watched import begun, numbered, tell, watcher_of
from course.engine.terms.paths.path_tracing import PathIntegrator
from course.engine.terms.paths.russian_roulette import survivors

FLIGHT = "fog flight"
"""The name of the numbers of flights, two for each box."""


@dataclass(frozen=True)
class FogPathIntegrator(PathIntegrator):
    """See ``PathIntegrator``; paths are scattered in fog, too."""

    fogs: Fogs = NO_FOG
    fog_lamps: Lamps | None = None

    def entered(
        self,
        rays: Rays,
        adds_lights: Mask | None,
        depth: int,
        path_radiance: Floats32,
        draws: Draws,
    ) -> tuple[Rays, Mask | None, Integrator, tuple[Rays, Mask | None] | None]:
        """See ``PathIntegrator``."""
        rays = numbered(rays, depth, draws)
        assert rays.path is not None
        path = rays.path
        origin = repeated(rays.origin, rays.size)
        found = self.surface.intersect(rays, draws.counters.embree, depth == 0)
        limit = np.where(found.triangle < 0, np.float32(np.inf), found.t)
        carried = np.ones((3, rays.size), np.float32)
        if rays.throughput is not None:
            carried = rays.throughput.copy()
        nearest, by = self._flown(origin, rays.direction, limit, carried, path, depth, draws)
        goes, stays = np.flatnonzero(by < 0), np.flatnonzero(by >= 0)
        turned = None
        if len(stays):
            whole = Rays(origin, rays.direction, carried, path, rays.medium, rays.time, origin)
            points = origin.take(stays, axis=1)
            points += nearest.take(stays) * rays.direction.take(stays, axis=1)
            stopped = _some(whole, stays, points)
            if (watcher := watcher_of(draws)) is not None:
                assert stopped.path is not None
                assert stopped.throughput is not None
                watcher.stopped(stopped.path, points, stopped.throughput)
            on = self._turned(stopped, by.take(stays), depth, path_radiance, draws)
            if on is not None:
                turned = on, np.ones(on.size, np.bool_) if self._rays_find_it else None
        draws.counters.lap("fog")
        if adds_lights is not None:
            adds_lights = adds_lights.take(goes)
        through = Rays(
            origin.take(goes, axis=1),
            rays.direction.take(goes, axis=1),
            carried.take(goes, axis=1),
            path.take(goes),
            None if rays.medium is None else rays.medium.take(goes),
            None if rays.time is None else rays.time.take(goes),
            None if rays.start is None else rays.start.take(goes, axis=1),
        )
        met = Intersections(
            found.triangle.take(goes), found.u.take(goes), found.v.take(goes), found.t.take(goes)
        )
        known: Any = KnownHits(self.surface, met)
        return through, adds_lights, replace(self, surface=known), turned

    def intersect(
        self,
        rays: Rays,
        adds_lights: Mask | bool,
        depth: int,
        path_radiance: Floats32,
        draws: Draws,
    ) -> tuple[Hits, Floats32 | None, Indices | None, Media | None]:
        """See ``Integrator``."""
        return super().intersect(rays, adds_lights, depth, path_radiance, begun(draws))

    @property
    def _rays_find_it(self) -> bool:
        """Whether rays find the environment by themselves, for they meet no lamp that shadow rays ask already."""
        lit = self.fog_lamps is not None and self.fog_lamps.environment is not None
        return lit and self.lamps is None and self.objects is None

    def _flown(
        self,
        origin: Floats32,
        direction: Floats32,
        limit: Floats32,
        carried: Floats32,
        path: Indices,
        depth: int,
        draws: Draws,
    ) -> tuple[Floats32, Indices]:
        """Where each flight ends (n,), and in which fog: -1 for none. ``carried`` is multiplied by what it is worth."""
        u = draws(FLIGHT, path, depth)
        n = direction.shape[1]
        nearest, by = np.full(n, np.inf, np.float32), np.full(n, -1)
        flights = []
        for number, fog in enumerate(self.fogs.all):
            start, length = fog.span(origin, direction, limit)
            which = np.flatnonzero(length > 0)
            ways = origin.take(which, axis=1), direction.take(which, axis=1)
            some = start.take(which), length.take(which)
            numbers = u[2 * number : 2 * number + 2].take(which, axis=1)
            end, stopped, weight = fog.flights(*ways, *some, numbers)
            flights.append((number, which, some[0], weight))
            ended, end = which[stopped], end[stopped]
            first = end < nearest[ended]
            nearest[ended[first]], by[ended[first]] = end[first], number
        for number, which, start, weight in flights:
            # What lies behind the place where a flight ends never was on its way.
            met = (by[which] == number) | (start < nearest[which])
            carried[:, which[met]] *= weight[:, met]
        return nearest, by

    def _turned(
        self, rays: Rays, by: Indices, depth: int, path_radiance: Floats32, draws: Draws
    ) -> Rays | None:
        """Rays that start in fog, after what lamps send there is added; None if all end."""
        lamps, path = self.fog_lamps, rays.path
        assert path is not None
        assert lamps is not None
        for light, which, u, counts in lamps.asked(path, depth, draws):
            some = _some(rays, which)
            assert some.path is not None
            lit = lamps.lit(light, some.origin, u, some.time, some.path, draws)
            self._add(some, by.take(which), lit, np.float32(counts), path_radiance, draws)
        v = draws(WAY[0], path, depth)
        toward = np.empty_like(rays.direction)
        share = np.empty(rays.size, np.float32)
        for number, fog in enumerate(self.fogs.all):
            which = np.flatnonzero(by == number)
            came = rays.direction.take(which, axis=1)
            way, odds = fog.media.sample_henyey_greenstein(came, fog.g, v.take(which, axis=1))
            toward[:, which] = way
            share[which] = fog.media.henyey_greenstein(dot(way, came), fog.g) / odds
        sky = None
        if depth == self.max_depth or not self._rays_find_it:
            sky = lamps.sky(rays.origin, toward, rays.time, path, draws)
        if sky is not None:
            self._add(rays, by, sky, share, path_radiance, draws, phased=False)
        if depth == self.max_depth:
            return None
        after = (rays.throughput if rays.throughput is not None else np.float32(1)) * share
        bounce, u = self.bounce, None
        plays = getattr(bounce.path_tracing, "russian_roulette", None) is not None
        if plays and bounce.roulette is not None and depth >= bounce.roulette:
            u = draws("choice", path, depth, 1, skip=1)[0]
        goes_on, after = survivors(bounce.path_tracing, after, u)
        which = np.flatnonzero(goes_on)
        if not len(which):
            return None
        draws.cast("path", len(which), path.take(which))
        kept = _some(rays, which)
        medium, start = None, None
        if bounce.scatter is not None and bounce.scatter.absorbs:
            medium = np.full(len(which), OPEN) if kept.medium is None else kept.medium
            start = kept.origin
        way = toward.take(which, axis=1)
        carried = after.take(which, axis=1)
        return Rays(kept.origin, way, carried, kept.path, medium, kept.time, start)

    def _add(
        self,
        rays: Rays,
        by: Indices,
        lit: ArrivingLight,
        counts: Floats32 | np.float32,
        path_radiance: Floats32,
        draws: Draws,
        phased: bool = True,
    ) -> None:
        """Add light that comes to where rays have been stopped.

        ``phased``: whether the phase function is still to count
        """
        which = lit.which
        assert rays.path is not None
        if not len(which):
            tell(draws, lit, rays.origin, rays.path, None)
            return
        some, by = _some(rays, which), by.take(which)
        share = np.broadcast_to(counts, rays.size).take(which).astype(np.float32)
        if phased:
            cos = dot(lit.toward, some.direction)
            for number, fog in enumerate(self.fogs.all):
                mine = np.flatnonzero(by == number)
                share[mine] *= fog.media.henyey_greenstein(cos.take(mine), fog.g)
        left = self.fogs.transmittance(some.origin, lit.toward, lit.distance)
        radiance = lit.radiance * left * share
        tell(draws, lit, rays.origin, rays.path, radiance)
        self.add_radiance(path_radiance, some.path, radiance, some.throughput)


def _some(rays: Rays, which: Indices, origin: Floats32 | None = None) -> Rays:
    """Some rays of a batch in which each has an origin of its own; ``origin`` (3, m) in the place of theirs."""
    return Rays(
        rays.origin.take(which, axis=1) if origin is None else origin,
        rays.direction.take(which, axis=1),
        None if rays.throughput is None else rays.throughput.take(which, axis=1),
        None if rays.path is None else rays.path.take(which),
        None if rays.medium is None else rays.medium.take(which),
        None if rays.time is None else rays.time.take(which),
    )
