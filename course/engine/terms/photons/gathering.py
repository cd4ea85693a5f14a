"""Light by way of matte surfaces in the distribution ray tracer: rays from each hit ask photons where they land.

H. W. Jensen, "Global illumination using photon maps", 1996. Photons are few and their light has spots; the mean over
many rays hasn't. Where a ray lands shadow rays bring the light of the lamps, and photons all light that surfaces have
sent there.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from course.engine.core.direct import Reflection
from course.engine.core.hits import Hits
from course.engine.core.integrator import CancelledError, Integrator
from course.engine.core.rays import RAYS, Draws, Rays
from course.engine.core.samplers import Block, Sampler
from course.engine.core.scatter import kept_above
from course.engine.core.types import Floats32, Functions, Indices
from course.engine.terms.photons.emission import matte
from course.engine.terms.photons.flight import Flight, Leg, at_rest
from course.engine.terms.photons.maps import Estimate
from course.engine.terms.photons.numbers import PHOTONS
from course.engine.terms.photons.passes import Passes
from course.engine.terms.photons.watched import paths_of, tell_gathered, unheard
from course.engine.terms.scattering.hemisphere import cosine_directions

GATHER = ("photon gather", 2)
"""Numbers of the directions of a hit's rays."""

COST = 8.0
"""A ray that gathers, its shadow rays and its photons, in camera rays that meet nothing."""


STEPS = (0.7548776662466927, 0.5698402909980532)
"""From each ray of a hit to the next, around the unit square.

M. Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018.
"""


@lru_cache(maxsize=64)
def _shifts(dimension: int, width: int, rays: int) -> Floats32:
    """What is added to the numbers (width, rays) of each of a hit's rays."""
    rng = np.random.default_rng((PHOTONS, dimension, width))
    return rng.random((width, rays), np.float32)


class ManySampler(Sampler):
    """Numbers of many rays for each of some paths (n,) of a block: the path's own, shifted around the unit square."""

    name = "gathering"
    extensible = True

    def __init__(self, sampler: Sampler, paths: Indices, rays: int) -> None:
        self._sampler, self._paths, self._rays = sampler, paths, rays

    def draw(self, block: Block, dimension: int, width: int) -> Floats32:
        """See ``Sampler``."""
        return self.draw_some(block, dimension, width, np.arange(len(self._paths) * self._rays))

    def draw_some(self, block: Block, dimension: int, width: int, path: Indices) -> Floats32:
        """See ``Sampler``."""
        point, ray = np.divmod(path, self._rays)
        u = self._sampler.draw_some(block, dimension, width, self._paths.take(point))
        u = u + _shifts(dimension, width, self._rays).take(ray, axis=1)
        return np.asarray(u - (u >= 1), np.float32)


@dataclass(frozen=True)
class Gathering:
    """Rays of each matte hit, and what photons say where they land.

    Attributes
    ----------
    sky : of ``DirectLight``, None if there is none
    shading : shades where rays land, without photons and without what lamps that are sampled give off
    reflection : of direct light
    flight : of the rays, by mirrors and glass
    passes : of photons; None where light is sent on once
    rays : of each hit
    module : functions of the module
    """

    sky: Callable[[Hits, Indices | None, int, Draws], Floats32 | None] | None
    shading: Integrator
    reflection: Reflection
    flight: Flight
    passes: Passes | None
    samples: int
    estimate: Estimate
    rays: int
    max_depth: int
    module: Functions

    def __call__(
        self, hits: Hits, path: Indices | None, depth: int, draws: Draws
    ) -> Floats32 | None:
        """Irradiance over pi (3, n), or None for 0; see ``DirectLight.sky``."""
        light = None if self.sky is None else self.sky(hits, path, depth, draws)
        shows = np.flatnonzero(matte(self.flight.diffuses, self.flight.refracts, hits))
        if not len(shows) or depth >= self.max_depth:
            return light
        if light is None:
            light = np.zeros((3, hits.size), np.float32)
        numbers = shows if path is None else path.take(shows)
        u, paths = draws(GATHER[0], numbers, depth), paths_of(draws, numbers)
        # The rays are counted as they go on.
        draws.cast("gather", 0, path, shows, COST * self.rays)
        together = max(1, RAYS // self.rays)
        for first in range(0, len(shows), together):
            if draws.cancelled():
                raise CancelledError
            part = slice(first, first + together)
            which = shows[part]
            rays = self._rays(hits, which, u[:, part])
            with unheard(draws):
                found, brought, reach = self._gathered(rays, paths[part], depth + 1, draws)
            light[:, which] += found
            if draws.watcher is not None:
                own = np.zeros((3, hits.size), np.float32)
                own[:, which] = found
                shown = self.reflection.reflected(hits, (own, None)).take(which, axis=1)
                tell_gathered(draws, rays, reach, numbers[part], shown, brought)
        draws.counters.lap("photons")
        return light

    def _rays(self, hits: Hits, which: Indices, u: Floats32) -> Rays:
        """Rays of some hits (m,), those of the first hit before those of the second."""
        steps = np.outer(STEPS, np.arange(self.rays)) % 1
        v = (u[:, :, None] + steps.astype(np.float32)[:, None]).reshape(2, -1)
        v -= v >= 1
        each = np.repeat(which, self.rays)
        way = cosine_directions(hits.ns.take(each, axis=1), v)
        way = kept_above(way, hits.ng.take(each, axis=1))
        time = None if hits.time is None else hits.time.take(each)
        origin = hits.near_origin.take(each, axis=1)
        return Rays(origin, way, np.ones_like(way), np.arange(len(each)), time=time)

    def _gathered(
        self, rays: Rays, paths: Indices, depth: int, draws: Draws
    ) -> tuple[Floats32, Floats32, Floats32]:
        """What rays of hits of paths (m,) bring.

        Returns
        -------
        found : (3, m) irradiance over pi
        brought : (3, m rays) radiance that each ray finds
        reach : (m rays,) how far it is to where each lands first, or infinite
        """
        m, count = len(paths), self.rays
        sampler = ManySampler(draws.sampler, paths, count)
        own = Draws(sampler, draws.dimensions, draws.block, draws.counters, draws.cancelled)
        found, brought = np.zeros((3, m), np.float32), np.zeros((3, m * count), np.float32)
        reach = np.full(m * count, np.inf, np.float32)
        legs = self.flight.legs(rays, "gather", depth, own)
        for number, leg in enumerate(legs):
            if number == 0:
                reach[leg.path] = leg.hits.t
            radiance = self._lit(leg, depth + number, paths, own, draws)
            if radiance is None:
                continue
            radiance = radiance * leg.power
            brought[:, leg.path] += radiance
            # A surface that is black, or nearly so, and shines counts as a white one that is lit.
            white = np.ones((3, leg.hits.size), np.float32), None
            albedo = self.reflection.reflected(leg.hits, white)
            albedo = np.where(albedo > 1e-3, albedo, np.float32(1))
            seen, irradiance = np.zeros((2, 3, m * count), np.float32)
            seen[:, leg.path] = albedo
            irradiance[:, leg.path] = radiance * np.float32(np.pi) / albedo
            # All rays of a hit stand together, and are to be the middle axis.
            of_hits = (a.reshape(3, m, count).swapaxes(1, 2) for a in (seen, irradiance))
            arrays = map(np.ascontiguousarray, of_hits)
            # The surface that gathers colours this with all other light.
            found += self.module.final_gather(np.ones_like(found), *arrays)
        return found, brought, reach

    def _lit(
        self, leg: Leg, depth: int, paths: Indices, own: Draws, draws: Draws
    ) -> Floats32 | None:
        """Radiance (3, n) of surfaces where rays have landed, which draw ``own`` numbers; None for 0."""
        hits = leg.hits
        radiance = self.shading.shade(hits, leg.path, depth, own)
        if self.passes is None:
            return radiance
        some = np.flatnonzero(matte(self.flight.diffuses, self.flight.refracts, hits))
        block = draws.block
        number = block.first + paths.take(leg.path.take(some) // self.rays) % block.samples
        number //= self.samples
        came = np.zeros((3, hits.size), np.float32)
        for each in np.unique(number).tolist():
            mine = some.compress(number == each)
            points = at_rest(self.flight.surface, hits, mine)
            photons = self.passes.of(each, draws)
            asked = points, hits.ng.take(mine, axis=1), self.module, self.estimate
            lit, found = photons.irradiance(*asked)
            came[:, mine.take(lit)] = found * np.float32(1 / np.pi)
        shown = self.reflection.reflected(hits, (came, None))
        return shown if radiance is None else radiance + shown
