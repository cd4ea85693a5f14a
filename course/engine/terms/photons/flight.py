"""The way of photons from a lamp from surface to surface, and which of them are kept."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from course.engine.core.hits import Hits, Surface
from course.engine.core.integrator import Absorption
from course.engine.core.materials import Lookup
from course.engine.core.rays import OPEN, Draws, Rays, join_rays
from course.engine.core.scatter import Boundary, Scatter, kept_above
from course.engine.core.types import Floats32, Functions, Indices, Mask, Media
from course.engine.terms.photons.emission import matte
from course.engine.terms.scattering.hemisphere import cosine_directions

CHOICE, BOUNCE = ("photon choice", 2), ("photon bounce", 2)
"""Numbers of whether a photon goes on, and by which way; and of its direction where a matte surface scatters it."""

SCATTERED, MIRRORED, REFRACTED = range(3)


@dataclass(frozen=True)
class Photons:
    """P photons: position, direction and power, (3, P) float32 each."""

    position: Floats32
    direction: Floats32
    power: Floats32

    @property
    def count(self) -> int:
        """P."""
        return int(self.position.shape[1])


def joined(parts: list[Photons]) -> Photons:
    """All of them."""
    none = [np.empty((3, 0), np.float32)]
    names = ("position", "direction", "power")
    return Photons(*(np.concatenate([getattr(p, n) for p in parts] or none, axis=1) for n in names))


@dataclass(frozen=True)
class Leg:
    """Hits of one depth, and rays that have come to them: power, path and medium of each hit (n,).

    ``specular``, ``diffuse``: (n,) how often mirrors and glass, and matte surfaces, have sent each of them on
    """

    hits: Hits
    carried: Rays
    specular: Indices
    diffuse: Indices

    @property
    def power(self) -> Floats32:
        """(3, n)."""
        assert self.carried.throughput is not None
        return self.carried.throughput

    @property
    def path(self) -> Indices:
        """(n,)."""
        assert self.carried.path is not None
        return self.carried.path


@dataclass(frozen=True)
class Flight:
    """Follows photons, and rays that look for them.

    Attributes
    ----------
    scatter : without a cutoff; a photon that is weak is as strong as others by roulette; None where nothing mirrors
    diffuses, refracts : (M,) which materials have a diffuse term, and which are glass
    bounces : most surfaces that send a photon on
    photons : functions of the module
    albedo : (3, M) what matte surfaces send on; None where they send nothing on
    """

    surface: Surface
    scatter: Scatter | None
    absorption: Absorption | None
    diffuses: Mask
    refracts: Mask
    bounces: int
    photons: Functions
    albedo: Lookup | None = None

    def __call__(self, rays: Rays, draws: Draws, indirect: bool) -> Photons:
        """Photons that are kept in the map of indirect light, or of caustics; the rays' throughput is their power."""
        kept: list[Photons] = []
        for leg in self.legs(rays, "photon", 0, draws):
            hits = leg.hits
            shows = matte(self.diffuses, self.refracts, hits)
            found = self.photons.stored(shows, leg.specular, leg.diffuse)[indirect]
            some = np.flatnonzero(found)
            if len(some):
                at = at_rest(self.surface, hits, some)
                way, power = hits.direction.take(some, axis=1), leg.power.take(some, axis=1)
                kept.append(Photons(at, way, power))
        return joined(kept)

    def legs(self, rays: Rays, kind: str, first: int, draws: Draws) -> Iterator[Leg]:
        """Rays with throughput and path from surface to surface; ``first`` is the depth of their numbers."""
        assert rays.path is not None
        # Of all paths, by their numbers.
        specular, diffuse = np.zeros((2, rays.path.max(initial=-1) + 1), np.int64)
        for depth in range(self.bounces + 1):
            draws.counters.rays[kind] += rays.size
            found = self.surface.intersect(rays, draws.counters.embree, False)
            hits = self.surface.hits(found, rays.direction, rays.time)
            if not hits.size:
                return
            which = np.arange(rays.size) if hits.ray is None else hits.ray
            assert rays.throughput is not None
            assert rays.path is not None
            power, path = rays.throughput.take(which, axis=1), rays.path.take(which)
            medium = None if rays.medium is None else rays.medium.take(which)
            if self.absorption is not None:
                lit = self.absorption(rays, hits, power, medium, False)
                power = power if lit is None else lit
            carried = replace(rays, throughput=power, path=path, medium=medium)
            yield Leg(hits, carried, specular.take(path), diffuse.take(path))
            if depth == self.bounces:
                return
            following = self._on(hits, carried, first + depth, draws)
            if following is None:
                return
            rays, scattered = following
            assert rays.path is not None
            diffuse[rays.path[:scattered]] += 1
            specular[rays.path[scattered:]] += 1

    def _on(self, hits: Hits, carried: Rays, depth: int, draws: Draws) -> tuple[Rays, int] | None:
        """Photons that surfaces send on, and how many of them, the first ones, are scattered by matte ones.

        ``carried`` has power, path and medium of each hit
        """
        scatter, path, power = self.scatter, carried.path, carried.throughput
        assert path is not None
        assert power is not None
        medium = carried.medium
        if scatter is not None and scatter.absorbs and medium is None:
            medium = np.full(hits.size, OPEN)
        ways, boundary = self._ways(hits, path, depth, draws)
        both = np.clip(sum(ways), 0, 1).astype(np.float32)
        some = np.flatnonzero(both.max(axis=0) > 0)
        if not len(some):
            return None
        u = draws(CHOICE[0], path, depth)
        lives, left = self.photons.roulette(
            np.ascontiguousarray(power.take(some, axis=1)),
            np.ascontiguousarray(both.take(some, axis=1)),
            np.ascontiguousarray(u[0].take(some)),
        )
        after = np.zeros((3, hits.size), np.float32)
        after[:, some] = left * lives
        goes = np.zeros(hits.size, np.bool_)
        goes[some] = lives
        # Of what goes on, each way has its share; its colour is made up for.
        odds = np.stack([(way * power).max(axis=0) for way in ways])
        reach = np.cumsum(odds, axis=0)
        taken = (u[1] * reach[-1] >= reach[:-1]).sum(axis=0)
        batches, scattered = [], 0
        for number, way in enumerate(ways):
            which = np.flatnonzero(goes & (taken == number))
            if len(which):
                chance = odds[number] / np.maximum(reach[-1], 1e-30)
                weighed = after * (way / np.maximum(both * chance, 1e-30))
                batches.append(
                    self._leaving(
                        hits, which, weighed, number, boundary, carried, medium, depth, draws
                    )
                )
                scattered += len(which) if number == SCATTERED else 0
        return (join_rays(batches), scattered) if batches else None

    def _ways(
        self, hits: Hits, path: Indices, depth: int, draws: Draws
    ) -> tuple[list[Floats32], Boundary | None]:
        """What each way takes of the light (3, n): scattered, mirrored, refracted; and the boundary of glass."""
        none = np.zeros((3, hits.size), np.float32)
        scattered, mirrored, through = none, none, none
        boundary = None
        if self.albedo is not None:
            scattered = self.albedo(hits.material) * matte(self.diffuses, self.refracts, hits)
            scattered = scattered if hits.tint is None else scattered * hits.tint
        if self.scatter is not None:
            mirrored = np.broadcast_to(self.scatter.reflectance(hits, None), (3, hits.size))
            if self.scatter.index is not None:
                boundary = self.scatter.boundary(hits, None, path, depth, draws)
                mirrored = mirrored + boundary.reflected
                through = np.repeat(boundary.refracted[None], 3, axis=0)
        return [scattered, mirrored, through], boundary

    def _leaving(
        self,
        hits: Hits,
        which: Indices,
        after: Floats32,
        taken: int,
        boundary: Boundary | None,
        carried: Rays,
        medium: Media | None,
        depth: int,
        draws: Draws,
    ) -> Rays:
        assert carried.path is not None
        path, power = carried.path.take(which), after.take(which, axis=1)
        time = None if hits.time is None else hits.time.take(which)
        behind = None if medium is None else medium.take(which)
        start = None if medium is None else hits.p.take(which, axis=1)
        scatter = self.scatter
        if taken == SCATTERED or scatter is None:
            u = draws(BOUNCE[0], path, depth)
            ng = hits.ng.take(which, axis=1)
            direction = kept_above(cosine_directions(hits.ns.take(which, axis=1), u), ng)
            origin = hits.near_origin.take(which, axis=1)
            return Rays(origin, direction, power, path, behind, time, start)
        through = taken == REFRACTED
        origin, power = scatter.origins(hits, which, 0 if through else len(which), after)
        if through:
            assert boundary is not None
            direction = scatter.refracted(hits, which, boundary.of(which), path, depth, draws)
        else:
            direction = scatter.mirrored(hits, which, path, depth, draws)
        count = scatter.weights(hits, which, direction, through)
        if count is not None:
            power = power * count
        if medium is not None and through:
            behind = scatter.medium_behind(hits, which)
        return Rays(origin, direction, np.asarray(power, np.float32), path, behind, time, start)


def at_rest(surface: Surface, hits: Hits, which: Indices) -> Floats32:
    """Points (3, m) of some hits where they are at time 0, so that what moves takes its photons with it."""
    points = np.ascontiguousarray(hits.p.take(which, axis=1))
    follow = getattr(surface.accelerator, "follow", None)
    if follow is not None and hits.time is not None:
        follow(points, hits.triangle.take(which), -hits.time.take(which))
    return points
