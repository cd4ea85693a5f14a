"""The way of photons from a lamp by mirrors and glass to the first matte surface, where they are kept."""

from dataclasses import dataclass, replace

import numpy as np

from course.engine.core.hits import Hits, Surface
from course.engine.core.integrator import Absorption
from course.engine.core.rays import OPEN, Draws, Rays, join_rays
from course.engine.core.scatter import Boundary, Scatter
from course.engine.core.types import Floats32, Functions, Indices, Mask, Media
from course.engine.terms.photons.emission import matte

CHOICE = ("photon choice", 2)
"""Numbers of whether a photon goes on, and of whether it is mirrored or refracted."""


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
class Flight:
    """Follows photons.

    Attributes
    ----------
    scatter : without a cutoff; a photon that is weak is as strong as others by roulette
    diffuses, refracts : (M,) which materials have a diffuse term, and which are glass
    bounces : most mirrors and boundaries of glass on a way
    photons : functions of the module
    """

    surface: Surface
    scatter: Scatter
    absorption: Absorption | None
    diffuses: Mask
    refracts: Mask
    bounces: int
    photons: Functions

    def __call__(self, rays: Rays, draws: Draws) -> Photons:
        """Photons that are kept; the rays' throughput is their power."""
        kept: list[Photons] = []
        n = rays.size
        specular, diffuse = np.zeros(n, np.int64), np.zeros(n, np.int64)
        for depth in range(self.bounces + 1):
            draws.counters.rays["photon"] += rays.size
            found = self.surface.intersect(rays, draws.counters.embree, False)
            hits = self.surface.hits(found, rays.direction, rays.time)
            if not hits.size:
                break
            which = np.arange(rays.size) if hits.ray is None else hits.ray
            assert rays.throughput is not None
            assert rays.path is not None
            power, path = rays.throughput.take(which, axis=1), rays.path.take(which)
            medium = None if rays.medium is None else rays.medium.take(which)
            if self.absorption is not None:
                lit = self.absorption(rays, hits, power, medium, False)
                power = power if lit is None else lit
            shows = matte(self.diffuses, self.refracts, hits)
            caustic, _ = self.photons.stored(shows, specular.take(path), diffuse.take(path))
            some = np.flatnonzero(caustic)
            if len(some):
                kept.append(
                    Photons(
                        at_rest(self.surface, hits, some),
                        hits.direction.take(some, axis=1),
                        power.take(some, axis=1),
                    )
                )
            if depth == self.bounces:
                break
            carried = replace(rays, throughput=power, path=path, medium=medium)
            following = self._on(hits, carried, depth, draws)
            if following is None:
                break
            rays = following
            assert rays.path is not None
            specular[rays.path] += 1
        return joined(kept)

    def _on(self, hits: Hits, carried: Rays, depth: int, draws: Draws) -> Rays | None:
        """Photons that mirrors and glass send on; ``carried`` has power, path and medium of each hit."""
        scatter, path, power = self.scatter, carried.path, carried.throughput
        assert path is not None
        assert power is not None
        medium = carried.medium
        if scatter.absorbs and medium is None:
            medium = np.full(hits.size, OPEN)
        mirrored = np.broadcast_to(scatter.reflectance(hits, None), (3, hits.size))
        through = np.zeros((1, hits.size), np.float32)
        boundary = None
        if scatter.index is not None:
            boundary = scatter.boundary(hits, None, path, depth, draws)
            mirrored = mirrored + boundary.reflected
            through = boundary.refracted[None]
        both = np.clip(mirrored + through, 0, 1).astype(np.float32)
        optical = np.flatnonzero(both.max(axis=0) > 0)
        if not len(optical):
            return None
        u = draws(CHOICE[0], path, depth)
        lives, left = self.photons.roulette(
            np.ascontiguousarray(power.take(optical, axis=1)),
            np.ascontiguousarray(both.take(optical, axis=1)),
            np.ascontiguousarray(u[0].take(optical)),
        )
        after = np.zeros((3, hits.size), np.float32)
        after[:, optical] = left * lives
        # Of what goes on, each way has its share; its colour is made up for.
        ways = mirrored * power, through * power
        odds = np.stack([way.max(axis=0) for way in ways])
        share = odds[0] / np.maximum(odds.sum(axis=0), 1e-30)
        goes = np.zeros(hits.size, np.bool_)
        goes[optical] = lives
        back = u[1] < share
        batches = []
        for through_it, chosen, way, chance in (
            (False, goes & back, mirrored, share),
            (True, goes & ~back, through, 1 - share),
        ):
            which = np.flatnonzero(chosen)
            if len(which):
                # (way / both) over its chance.
                scale = way / np.maximum(both * chance, 1e-30)
                weighed = after * scale
                batches.append(
                    self._leaving(
                        hits, which, weighed, through_it, boundary, carried, medium, depth, draws
                    )
                )
        return join_rays(batches) if batches else None

    def _leaving(
        self,
        hits: Hits,
        which: Indices,
        after: Floats32,
        through: bool,
        boundary: Boundary | None,
        carried: Rays,
        medium: Media | None,
        depth: int,
        draws: Draws,
    ) -> Rays:
        scatter = self.scatter
        assert carried.path is not None
        path = carried.path.take(which)
        origin, power = scatter.origins(hits, which, 0 if through else len(which), after)
        if through:
            assert boundary is not None
            direction = scatter.refracted(hits, which, boundary.of(which), path, depth, draws)
        else:
            direction = scatter.mirrored(hits, which, path, depth, draws)
        count = scatter.weights(hits, which, direction, through)
        if count is not None:
            power = power * count
        start = None
        behind = None
        if medium is not None:
            behind = scatter.medium_behind(hits, which) if through else medium.take(which)
            start = hits.p.take(which, axis=1)
        time = None if hits.time is None else hits.time.take(which)
        return Rays(origin, direction, np.asarray(power, np.float32), path, behind, time, start)


def at_rest(surface: Surface, hits: Hits, which: Indices) -> Floats32:
    """Points (3, m) of some hits where they are at time 0, so that what moves takes its photons with it."""
    points = np.ascontiguousarray(hits.p.take(which, axis=1))
    follow = getattr(surface.accelerator, "follow", None)
    if follow is not None and hits.time is not None:
        follow(points, hits.triangle.take(which), -hits.time.take(which))
    return points
