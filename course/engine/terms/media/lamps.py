"""Lamps as places in fog see them: which are asked, by which numbers, and what comes if nothing is in the way."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from course.engine.core.environment import Environment
from course.engine.core.hits import Surface
from course.engine.core.lights.sample import TO_THE_LIGHT, Light
from course.engine.core.motion import Motion
from course.engine.core.rays import Draws
from course.engine.core.types import Floats32, Indices, Numbers
from course.engine.core.vectors import repeated
from course.engine.terms.environments.sky import FAR

WAY, CHOICE = ("fog way", 2), ("fog lamp", 4)
"""Numbers of the direction in which light goes on; and of which of many lamps is asked and of a point on it."""


def own(light: Light) -> str:
    """The name of the numbers that places in fog ask a light with; those of surfaces are others."""
    return f"fog {light.name}"


Blocked = tuple[Indices, Floats32, Numbers, Floats32]
"""See ``ArrivingLight``."""


@dataclass(frozen=True)
class ArrivingLight:
    """Light that comes to some places.

    Attributes
    ----------
    which : (m,) the places
    radiance : (3, m) float32: times phase function and transmittance it is the radiance that is scattered
    toward : (3, m) float32, unit vectors to where it comes from
    distance : (m,) float32 to there, infinite from far away
    light : the light's name; "" for the environment
    blocked : for a watcher, of places from which it isn't seen: which they are (k,), the ways (3, k) of shadow rays,
        what triangles block these, and how far away in lengths of the ways; None without one
    """

    which: Indices
    radiance: Floats32
    toward: Floats32
    distance: Floats32
    light: str = ""
    blocked: Blocked | None = None


@dataclass(frozen=True)
class Lamps:
    """All lamps of a scene.

    Attributes
    ----------
    lights : the lights of the scene
    environment : None where the environment is no light
    one : whether one light is chosen for each place, as hits choose one of many
    """

    surface: Surface
    lights: tuple[Light, ...]
    environment: Environment | None
    motion: Motion | None
    one: bool

    @property
    def numbers(self) -> list[tuple[str, int]]:
        """Names and widths of what one place draws."""
        found = [CHOICE] if self.one else [(own(light), light.width) for light in self.lights]
        return [WAY, *found]

    def asked(
        self, path: Indices, depth: int, draws: Draws
    ) -> Iterator[tuple[Light, Indices, Floats32 | None, float]]:
        """Lights, the places (m,) that ask them, numbers (width, m) and what their light counts; paths are (n,)."""
        if not self.one:
            for light in self.lights:
                u = draws(own(light), path, depth) if light.width else None
                yield light, np.arange(len(path)), u, 1.0
            return
        u = draws(CHOICE[0], path, depth)
        count = len(self.lights)
        chosen = np.minimum((u[0] * np.float32(count)).astype(np.intp), count - 1)
        for number in np.unique(chosen).tolist():
            light, which = self.lights[number], np.flatnonzero(chosen == number)
            some = u[1 : 1 + light.width].take(which, axis=1) if light.width else None
            yield light, which, some, float(count)

    def place_of(
        self, light: Light, points: Floats32, u: Floats32 | None, time: Floats32 | None
    ) -> Floats32 | None:
        """Points (3, n) on a light that are sampled from points (3, n); None if it is infinitely far away."""
        if light.limit > TO_THE_LIGHT:
            return None
        moved = self._moved(light, time)
        # As the sample leaves it: in the frame of the light, and back.
        to_light = light.sample(points if moved is None else points - moved, u).to_light
        return repeated(to_light, points.shape[1]) + points

    def lit(
        self,
        light: Light,
        points: Floats32,
        u: Floats32 | None,
        time: Floats32 | None,
        path: Indices,
        draws: Draws,
    ) -> ArrivingLight:
        """What comes from a point on a light to points (3, n) of paths (n,)."""
        n = points.shape[1]
        moved = self._moved(light, time)
        sample = light.sample(points if moved is None else points - moved, u)
        factor = np.broadcast_to(sample.factor, n)
        which = np.flatnonzero(factor > 0)
        way = repeated(sample.to_light, n).take(which, axis=1)
        asked = points, light.short_of(way), light.limit, time, path, which, draws
        free, blocked = self._free(*asked)
        which, way = which[free], way[:, free]
        inverse = np.broadcast_to(sample.inverse_length, n).take(which)
        endless = light.limit > TO_THE_LIGHT
        distance = np.float32(np.inf if endless else 1) / inverse
        # A light's colour is over pi, for surfaces.
        radiance = np.float32(np.pi) * light.color[:, None] * factor.take(which)
        return ArrivingLight(which, radiance, way * inverse, distance, light.name, blocked)

    def sky(
        self,
        points: Floats32,
        toward: Floats32,
        time: Floats32 | None,
        path: Indices,
        draws: Draws,
    ) -> ArrivingLight | None:
        """What comes from the environment in directions (3, n); None if it is no light."""
        if self.environment is None:
            return None
        every = np.arange(points.shape[1])
        free, blocked = self._free(points, toward, FAR, time, path, every, draws)
        toward = toward[:, free]
        radiance = repeated(self.environment.radiance(toward), toward.shape[1])
        far = np.full(toward.shape[1], np.inf, np.float32)
        return ArrivingLight(every[free], radiance, toward, far, "", blocked)

    def _free(
        self,
        points: Floats32,
        way: Floats32,
        limit: float,
        time: Floats32 | None,
        path: Indices,
        which: Indices,
        draws: Draws,
    ) -> tuple[Indices, Blocked | None]:
        """Which of the ways (3, m) from some points are free, as indices; and what blocks the others, for a watcher."""
        draws.cast("shadow", len(which), path, which)
        start = np.ascontiguousarray(points.take(which, axis=1))
        way, stats = np.ascontiguousarray(way), draws.counters.embree
        when = None if time is None else time.take(which)
        accelerator = self.surface.accelerator
        free = accelerator.unoccluded(start, way, limit, stats, when)
        blocked = None
        if draws.watcher is not None:
            shut = np.flatnonzero(~free)
            length = np.linalg.norm(way.take(shut, axis=1), axis=0)
            ways = start.take(shut, axis=1), way.take(shut, axis=1) / length
            found = accelerator.intersect(*ways, stats, None if when is None else when.take(shut))
            blocked = which.take(shut), way.take(shut, axis=1), found.triangle, found.t / length
        return np.flatnonzero(free), blocked

    def _moved(self, light: Light, time: Floats32 | None) -> Floats32 | None:
        if light.velocity is None or self.motion is None or time is None:
            return None
        return self.motion.moved(light.velocity, time)
