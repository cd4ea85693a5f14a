"""Caustics beside direct light: photons of progressive passes, a pass for each few samples of a pixel.

C. Knaus and M. Zwicker, "Progressive photon mapping: a probabilistic approach", 2011. The picture is the mean over
samples, and so over passes. A pass hangs on the seed and on its number alone, not on who asks for it first.
"""

import warnings
from collections.abc import Callable
from dataclasses import dataclass, field, fields, replace
from functools import cached_property

import numpy as np

from course.base.errors import CourseWarning
from course.engine.core.direct import Reflection
from course.engine.core.hits import Hits
from course.engine.core.integrator import CancelledError, Integrator
from course.engine.core.lights.sample import Light
from course.engine.core.motion import Motion
from course.engine.core.rays import Dimensions, Draws, Rays
from course.engine.core.samplers import Block
from course.engine.core.types import Floats32, Functions, Indices, Mask
from course.engine.terms.paths.path_tracing import PathIntegrator
from course.engine.terms.photons.emission import WIDTH, Target, leaving, matte
from course.engine.terms.photons.flight import CHOICE, Flight, Photons, at_rest, joined
from course.engine.terms.photons.maps import KEPT, Maps, PhotonMap
from course.engine.terms.photons.numbers import PhotonSampler, seed_of, spread
from course.engine.terms.photons.watched import paths_of, tell, unheard

BATCH = 1 << 17
"""Photons that are followed together."""

MOST = KEPT // 4
"""Photons of a pass that are kept: from then on no more are sent out, and those that were stand for all."""

TRIED = 64
"""Photons that tell how much a light sends to mirrors and glass."""


@dataclass(frozen=True)
class PhotonSettings:
    """What a scene asks for; ``radius`` in units of the compiled scene, ``samples`` of a pixel that share a pass."""

    count: int
    radius: float
    alpha: float
    cone: float
    samples: int


@dataclass(frozen=True)
class PhotonStage:
    """See ``Wrap`` in ``course.engine.terms.world``.

    Attributes
    ----------
    diffuses, refracts : (M,) which materials have a diffuse term, and which are glass
    """

    settings: PhotonSettings
    lights: tuple[Light, ...]
    motion: Motion | None
    diffuses: Mask
    refracts: Mask
    target: Target
    module: Functions
    where: str

    def numbers(self, paths: bool) -> list[tuple[str, int]]:
        """See ``Wrap``: the paths from the eye draw none."""
        del paths
        return []

    def around(self, integrator: Integrator, max_depth: int) -> Integrator:
        """See ``Wrap``."""
        if integrator.direct is None or integrator.scatter is None:
            return integrator
        scatter = replace(integrator.scatter, cutoff=0.0)
        materials = self.diffuses, self.refracts
        known = integrator.surface, scatter, integrator.absorption, *materials
        flight = Flight(*known, max_depth, self.module)
        caustics = Caustics(self, flight, integrator.direct.reflection, integrator.direct.sky)
        direct = replace(integrator.direct, sky=caustics)
        if not isinstance(integrator, PathIntegrator):
            return replace(integrator, direct=direct)
        same = {each.name: getattr(integrator, each.name) for each in fields(integrator)}
        return PhotonPathIntegrator(**same | {"direct": direct})


@dataclass(frozen=True)
class Caustics:
    """What photons bring to hits, beside what the environment does.

    ``sky`` : of ``DirectLight``, None if there is none
    """

    stage: PhotonStage
    flight: Flight
    reflection: Reflection
    sky: Callable[[Hits, Indices | None, int, Draws], Floats32 | None] | None
    told: list[bool] = field(default_factory=list)

    @cached_property
    def radii(self) -> list[Floats32]:
        """Those of the first passes, (1,) each, as far as any was asked for."""
        return [np.full(1, self.stage.settings.radius, np.float32)]

    @cached_property
    def maps(self) -> Maps:
        """The passes."""
        return Maps(self._made)

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
            points, normal = at_rest(self.flight.surface, hits, some), hits.ng.take(some, axis=1)
            with unheard(draws):
                photons = self.maps.of(each, draws)
                lit, found = photons.irradiance(points, normal, self.stage.module, settings.cone)
            if len(lit):
                if light is None:
                    light = np.zeros((3, hits.size), np.float32)
                own = np.zeros((3, hits.size), np.float32)
                own[:, some.take(lit)] = found * np.float32(1 / np.pi)
                light += own
                if draws.watcher is not None and path is not None:
                    asked = photons, hits, path, some, points, normal, lit
                    self._tell(draws, *asked, own)
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
            near = photons.pairs(points, normal, lit, self.stage.module, self.stage.settings.cone)
        places = hits.p.take(some, axis=1)
        away = self.stage.target.radius
        tell(draws, photons, near, path.take(some), places, shown.take(some, axis=1), away)

    def _made(self, number: int, draws: Draws) -> PhotonMap:
        """The photons of a pass."""
        seed, radius = seed_of(draws), self._radius(number)
        counts, sent, kept = self._shares, 0, list[Photons]()
        total = sum(counts)
        starts = np.cumsum([0, *counts]).tolist()
        stored = 0
        # A stretch of each light's photons after the other, so that all lights have their share wherever it ends.
        rounds = max(1, -(-total // BATCH))
        for part in range(rounds):
            if draws.cancelled():
                raise CancelledError
            for light, count, start in zip(self.stage.lights, counts, starts, strict=False):
                first, last = count * part // rounds, count * (part + 1) // rounds
                if last > first:
                    part_of = start + first, last - first, number, seed
                    found = self._flown(light, count, part_of, draws)
                    kept.append(found)
                    stored += found.count
            sent = part + 1
            if stored >= MOST:
                break
        photons = joined(kept)
        if sent < rounds:
            photons = replace(photons, power=photons.power * np.float32(rounds / sent))
        # Lamps without any power send none.
        if total and not photons.count and not self.told:
            self.told.append(True)
            warnings.warn(
                f"{self.stage.where}: none of {total:,} photons has come to a matte surface by way of a mirror or"
                " glass: there is no caustic, or few photons find it; give it more of them",
                CourseWarning,
                stacklevel=2,
            )
        return PhotonMap.of(photons, radius)

    def _radius(self, number: int) -> float:
        """The radius of a pass; passes are made one at a time."""
        while len(self.radii) <= number:
            i, alpha = np.array([len(self.radii)]), self.stage.settings.alpha
            self.radii.append(self.stage.module.shrunk_radius(self.radii[-1], i, alpha))
        return float(self.radii[number][0])

    @cached_property
    def _shares(self) -> list[int]:
        """How many photons leave each light: as many as it sends power to the mirrors and the glass."""
        u = spread(0, 0, 0, TRIED, WIDTH)
        power = []
        for light in self.stage.lights:
            sent = leaving(light, 1, u, self.stage.module, self.stage.target)[2]
            power.append(float(sent.astype(np.float64).mean()))
        whole = sum(power)
        count = self.stage.settings.count
        return [max(round(count * each / whole), 1) if each > 0 else 0 for each in power]

    def _flown(
        self, light: Light, count: int, part: tuple[int, int, int, int], draws: Draws
    ) -> Photons:
        """Some of a light's photons, from their start to where they are kept."""
        stage = self.stage
        first, n, number, seed = part
        u = spread(seed, number + 1, first, n, WIDTH + 1)
        origin, direction, power = leaving(light, count, u[:WIDTH], stage.module, stage.target)
        time = None
        if stage.motion is not None:
            # As a share of the exposure.
            time = np.ascontiguousarray(u[WIDTH])
            if light.velocity is not None:
                origin = origin + stage.motion.moved(light.velocity, time)
        strong = np.flatnonzero(power.max(axis=0) > 0)
        origin, direction, power = (
            np.ascontiguousarray(a.take(strong, axis=1), np.float32)
            for a in (origin, direction, power)
        )
        when = None if time is None else time.take(strong)
        rays = Rays(origin, direction, power, np.arange(len(strong)), time=when)
        given = draws.dimensions
        bounce = [(name, w) for name, w in given.width.items() if name not in given.of_path]
        own = Draws(
            PhotonSampler(seed),
            Dimensions([], [CHOICE, *bounce]),
            Block(np.arange(len(strong), dtype=np.uint32), number, 1, first),
            draws.counters,
            draws.cancelled,
        )
        return self.flight(rays, own)


@dataclass(frozen=True)
class PhotonPathIntegrator(PathIntegrator):
    """See ``PathIntegrator``; light that comes to a diffuse surface by mirrors and glass alone is left to photons."""

    def _step(
        self,
        rays: Rays,
        adds_lights: Mask | None,
        depth: int,
        path_radiance: Floats32,
        draws: Draws,
    ) -> tuple[Rays, Mask | None] | None:
        following = super()._step(rays, adds_lights, depth, path_radiance, draws)
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
