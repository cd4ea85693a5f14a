"""Photons of progressive passes: how many leave each lamp, and the map of those that are kept."""

import warnings
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from course.base.errors import CourseWarning
from course.engine.core.integrator import CancelledError
from course.engine.core.motion import Motion
from course.engine.core.rays import Dimensions, Draws, Rays
from course.engine.core.samplers import Block
from course.engine.core.types import Floats32, Functions
from course.engine.terms.photons.emission import WIDTH, Lamp, Target, leaving
from course.engine.terms.photons.flight import BOUNCE, CHOICE, Flight, Photons, joined
from course.engine.terms.photons.maps import KEPT, Maps, PhotonMap
from course.engine.terms.photons.numbers import PhotonSampler, seed_of, spread

BATCH = 1 << 17
"""Photons that are followed together."""

MOST = KEPT // 4
"""Photons of a pass that are kept: from then on no more are sent out, and those that were stand for all."""

TRIED = 64
"""Photons that tell how much a light sends to the target."""


@dataclass(frozen=True)
class Passes:
    """Passes of photons that are sent to a target.

    Attributes
    ----------
    count : photons of a pass
    radius : of the first pass, in units of the compiled scene
    alpha : see ``shrunk_radius``
    indirect : whether all light by way of surfaces is kept, or caustics alone
    module : functions of the module
    where : the key that asks for them, with its file and line
    """

    lights: tuple[Lamp, ...]
    motion: Motion | None
    target: Target
    flight: Flight
    count: int
    radius: float
    alpha: float
    indirect: bool
    module: Functions
    where: str
    maps: Maps
    told: list[bool] = field(default_factory=list)

    def of(self, number: int, draws: Draws) -> PhotonMap:
        """The map of a pass."""
        return self.maps.of((self.indirect, number), lambda: self._made(number, draws))

    @cached_property
    def _radii(self) -> list[Floats32]:
        """Those of the first passes, (1,) each, as far as any was asked for."""
        return [np.full(1, self.radius, np.float32)]

    def _radius(self, number: int) -> float:
        """The radius of a pass; passes are made one at a time."""
        while len(self._radii) <= number:
            i = np.array([len(self._radii)])
            self._radii.append(self.module.shrunk_radius(self._radii[-1], i, self.alpha))
        return float(self._radii[number][0])

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
            for light, count, start in zip(self.lights, counts, starts, strict=False):
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
            way, what = "a mirror or glass", "caustic"
            if self.indirect:
                way, what = "another surface", "light to gather"
            warnings.warn(
                f"{self.where}: none of {total:,} photons has come to a matte surface by way of {way}:"
                f" there is no {what}, or few photons find it; give it more of them",
                CourseWarning,
                stacklevel=2,
            )
        return PhotonMap.of(photons, radius)

    @cached_property
    def _shares(self) -> list[int]:
        """How many photons leave each light: as many as it sends power to the target."""
        u = spread(0, 0, 0, TRIED, WIDTH)
        power = []
        for light in self.lights:
            sent = leaving(light, 1, u, self.module, self.target)[2]
            power.append(float(sent.astype(np.float64).mean()))
        whole = sum(power)
        return [max(round(self.count * each / whole), 1) if each > 0 else 0 for each in power]

    def _flown(
        self, light: Lamp, count: int, part: tuple[int, int, int, int], draws: Draws
    ) -> Photons:
        """Some of a light's photons, from their start to where they are kept."""
        first, n, number, seed = part
        u = spread(seed, number + 1, first, n, WIDTH + 1)
        origin, direction, power = leaving(light, count, u[:WIDTH], self.module, self.target)
        time = None
        if self.motion is not None:
            # As a share of the exposure.
            time = np.ascontiguousarray(u[WIDTH])
            if light.velocity is not None:
                origin = origin + self.motion.moved(light.velocity, time)
        strong = np.flatnonzero(power.max(axis=0) > 0)
        origin, direction, power = (
            np.ascontiguousarray(a.take(strong, axis=1), np.float32)
            for a in (origin, direction, power)
        )
        when = None if time is None else time.take(strong)
        rays = Rays(origin, direction, power, np.arange(len(strong)), time=when)
        given = draws.dimensions
        bounce = [
            (name, width)
            for name, width in given.width.items()
            if name not in given.of_path and (name, width) not in (CHOICE, BOUNCE)
        ]
        own = Draws(
            PhotonSampler(seed),
            Dimensions([], [CHOICE, BOUNCE, *bounce]),
            Block(np.arange(len(strong), dtype=np.uint32), number, 1, first),
            draws.counters,
            draws.cancelled,
        )
        return self.flight(rays, own, self.indirect)
