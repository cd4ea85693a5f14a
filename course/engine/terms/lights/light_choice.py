"""One light for each hit, chosen at random, in the place of all of them: for scenes with many.

The light that is chosen counts 1 / p times, where p is the probability of its choice, so the mean is that of all
lights. A choice by power has a p in proportion to the power that a light sends out (Shirley, Wang and Zimmerman, "Monte
Carlo techniques for direct lighting calculations", 1996, section 5). A better choice knows the hit: ``LightChoice`` is
all that it has to have.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass, fields
from functools import cached_property
from typing import Any

import numpy as np

from course.engine.core.direct import Ask, Sums
from course.engine.core.hits import Hits
from course.engine.core.lights.point import DirectionalLight, PointLight
from course.engine.core.lights.rectangle import RectangleLight
from course.engine.core.lights.sample import Light, Sample
from course.engine.core.lights.sphere import SphereLight
from course.engine.core.rays import Draws
from course.engine.core.types import Floats32, Indices

WHICH, WHERE = "light choice", "place on light"
"""Names of the random numbers that choose a light, and a point on it."""

UNIFORM = 0.1
"""Share of the choices that is uniform: a weak lamp near a hit would else count thousands of times, and seldom."""

Group = tuple[Light, Indices | None]
"""A light that stands for several, and the hits (m,) that have chosen one of them; None for all hits."""


@dataclass(frozen=True)
class LightChoice(ABC):
    """Chooses a light for each hit.

    Attributes
    ----------
    lights : L lights, each with a power
    together : true if lights of a kind are asked for their points in one go, which makes the same bits in less time
    """

    lights: tuple[Light, ...]
    together: bool = True

    @abstractmethod
    def choose(self, hits: Hits, u: Floats32) -> tuple[Indices, Floats32]:
        """The number of a light for each of n hits (n,), and 1 / its probability (n,) float32; u (n,) in [0, 1)."""

    @cached_property
    def width(self) -> int:
        """Random numbers that a point on a light takes."""
        return max(light.width for light in self.lights)

    @cached_property
    def _kinds(self) -> tuple[Indices, tuple[Floats32, ...], Floats32]:
        """The number of each light's kind (L,), each kind's colour (3,), and how many times that a light has (L,)."""
        keys: dict[Any, int] = {}
        kinds, colors, shares = list[int](), list[Floats32](), list[float]()
        for number, light in enumerate(self.lights):
            # A light whose colour is lost to float32, in a scene of 1e30, is black.
            share = float(light.color.max()) or 1.0
            key = number if not self.together else _kind(light, light.color / share)
            kind = keys.setdefault(key, len(keys))
            kinds.append(kind)
            if kind == len(colors):
                colors.append(light.color / share)
            shares.append(share)
        return np.array(kinds), tuple(colors), np.array(shares, np.float32)

    @cached_property
    def positions(self) -> Floats32:
        """(3, L) of the lights that are points, anything of the others."""
        nowhere = np.zeros(3, np.float32)
        places = [
            each.position if isinstance(each, PointLight) else nowhere for each in self.lights
        ]
        return np.array(places, np.float32).T

    def __call__(
        self, ask: Ask, hits: Hits, path: Indices | None, depth: int, draws: Draws
    ) -> Sums:
        """See ``course.engine.core.direct.LightChoice``."""
        u = draws(WHICH, path, depth)[0]
        places = draws(WHERE, path, depth) if self.width else None
        diffuse: Floats32 | None = None
        specular: Floats32 | None = None
        for light, which in self.groups(hits, u, places):
            if which is None:
                return ask(light, (None, None), hits, path, depth, draws)
            of = which if path is None else path.take(which)
            more = ask(light, (None, None), some_of(hits, which), of, depth, draws)
            diffuse = _spread(diffuse, more[0], which, hits.size)
            specular = _spread(specular, more[1], which, hits.size)
        return diffuse, specular

    def groups(self, hits: Hits, u: Floats32, places: Floats32 | None) -> Iterator[Group]:
        """Lights for n hits, one for those of each kind.

        Parameters
        ----------
        u : (n,) in [0, 1)
        places : (width, n) in [0, 1), None where the width is 0
        """
        number, weight = self.choose(hits, u)
        kinds, colors, shares = self._kinds
        weight *= shares.take(number)
        kind = kinds.take(number)
        order = kind.argsort(kind="stable")
        bounds = np.searchsorted(kind, np.arange(len(colors) + 1), sorter=order)
        for color, first, last in zip(colors, bounds[:-1], bounds[1:], strict=True):
            if last == first:
                continue
            which = None if last - first == len(number) else order[first:last]
            light = self.lights[number[order[first]]]
            some = number, weight, places
            if which is not None:
                some = (number.take(which), weight.take(which), _taken(places, which))
            yield (
                ChosenLight(light.name, color, light.velocity, self, *some, limit=light.limit),
                which,
            )


def _taken(places: Floats32 | None, which: Indices) -> Floats32 | None:
    return None if places is None else places.take(which, axis=1)


def _kind(light: Light, hue: Floats32) -> Any:
    """Equal for lights that differ only in where their points lie, and in how bright they are."""
    velocity = None if light.velocity is None else light.velocity.tobytes()
    facing: Any = ()
    # Not of a light that sends more to one side, such as a spot light.
    if type(light) is PointLight:
        facing = None if light.normal is None else light.normal.tobytes(), light.two_sided
    # The brightest channel is 1: seven digits are as many as float32 has.
    return tuple(np.round(hue.astype(np.float64), 7).tolist()), light.limit, velocity, facing


@dataclass(frozen=True)
class PowerChoice(LightChoice):
    """Chooses by power, whatever the hit.

    Attributes
    ----------
    uniform : share of the choices that doesn't look at the power, 1 for all
    """

    uniform: float = UNIFORM

    @cached_property
    def _ends(self) -> Floats32:
        """Ends (L,) of the lights' shares of [0, 1)."""
        power = np.array([power_of(light) for light in self.lights])
        share = (1 - self.uniform) * power / (power.sum() or 1) + self.uniform / len(power)
        ends = np.cumsum(share)
        # In float32, as the numbers are that they are compared with.
        return np.asarray(ends / ends[-1], np.float32)

    @cached_property
    def probabilities(self) -> Floats32:
        """(L,), of each light, as the numbers have it."""
        return np.diff(self._ends, prepend=np.float32(0))

    def choose(self, _hits: Hits, u: Floats32) -> tuple[Indices, Floats32]:
        """See ``LightChoice``."""
        number = np.searchsorted(self._ends[:-1], u, side="right")
        return number, np.float32(1) / self.probabilities.take(number)


SCENE = 3.0
"""Squared radius of the ball around the compiled scene, which lies within [-1, 1] in each coordinate."""


def power_of(light: Light) -> float:
    """Power that a light sends out, in units of pi^2 times the mean of its colour (``Light.color``).

    An intensity I sends 4 pi I, an emitter pi times its radiance times its area, and a sun what meets the scene.
    """
    factor = 1.0
    match light:
        case DirectionalLight():
            factor = SCENE
        case PointLight() | RectangleLight():
            # A spot light sends its intensity into a part of all directions.
            whole = getattr(light, "solid_angle", 4 * math.pi) / math.pi
            factor = whole if light.normal is None else 1.0 + light.two_sided
        case SphereLight():
            factor = 1.0 if light.emitter else 4.0
    return factor * float(light.color.mean())


@dataclass(frozen=True)
class ChosenLight(Light):
    """Of n shading points each has one of several lights, which have one hue, one velocity and one limit.

    Attributes
    ----------
    choice : what has chosen
    number : (n,) of the light of each point
    weight : (n,) float32, what ``color`` is multiplied by
    places : (choice.width, n) in [0, 1), numbers for points on the lights
    """

    name: str
    color: Floats32
    velocity: Floats32 | None
    choice: LightChoice
    number: Indices
    weight: Floats32
    places: Floats32 | None
    limit: float = 1.0
    width: int = 0

    def sample(self, points: Floats32, _u: Floats32 | None) -> Sample:
        """See ``Light``; the numbers are those of ``places``."""
        choice, n = self.choice, len(self.number)
        first = choice.lights[self.number[0]]
        if type(first) is PointLight:
            on_light = choice.positions.take(self.number, axis=1)
            found = first.from_point(on_light, points, on_light)
            to_light, lengths, factor = found.to_light, found.inverse_length, found.factor
        else:
            to_light, (lengths, factor) = (
                np.empty((3, n), np.float32),
                np.empty((2, n), np.float32),
            )
            order = self.number.argsort(kind="stable")
            chosen, starts = np.unique(self.number.take(order), return_index=True)
            for number, which in zip(chosen, np.split(order, starts[1:]), strict=True):
                light = choice.lights[number]
                u = None
                if self.places is not None and light.width:
                    u = self.places[: light.width].take(which, axis=1)
                one = light.sample(points.take(which, axis=1), u)
                to_light[:, which] = one.to_light
                lengths[which], factor[which] = one.inverse_length, one.factor
        return Sample(to_light, lengths, factor * self.weight)


def _spread(
    total: Floats32 | None, values: Floats32 | None, which: Indices, n: int
) -> Floats32 | None:
    """The total (3, n) with values (3, m) at the hits ``which`` (m,); None stands for 0."""
    if values is None:
        return total
    total = np.zeros((3, n), np.float32) if total is None else total
    total[:, which] = values
    return total


def some_of(hits: Hits, which: Indices) -> Hits:
    """Some (m,) of n hits."""
    arrays: Any = [getattr(hits, each.name) for each in fields(hits)]
    chosen: Any = [None if array is None else array.take(which, axis=-1) for array in arrays]
    return type(hits)(*chosen)
