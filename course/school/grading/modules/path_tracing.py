"""path_tracing declared: the directions of diffuse bounces, what they leave of the light, and Russian roulette.

A right function may turn its directions about the normal as it likes, so only what stays the same is looked at: the
cosine, and that all turns come alike. Where a path survives by a hair, rounding decides; no law comes nearer than
``HAIR``.
"""

from collections.abc import Mapping
from math import pi
from typing import Any

import numpy as np

from course.school.grading.checks import declare, laws
from course.school.grading.checks.check import Array
from course.school.grading.checks.declare import Arguments, Law, Made, function
from course.school.grading.checks.distributions import means, uniform
from course.school.grading.checks.drawing import Draw, worst_directions, worst_units
from course.school.grading.checks.evenness import evenly, smooth
from course.school.grading.checks.vectors import dot, turn_about
from course.school.grading.modules.round_shapes import cornered

HAIR = 1e-4
"""How near u comes to the probability to survive."""


# ---------------------------------------------------------------- diffuse_bounce


def _steep(draw: Draw) -> Mapping[str, Any]:
    """Normals that bases have trouble with, and numbers at the ends of [0, 1)."""
    found = {}
    for name, ends in (("normal", worst_directions(draw.dtype)), ("u", worst_units(2, draw.dtype))):
        found[name] = ends[:, draw.rng.integers(0, ends.shape[1], draw.n)]
    return found


def _along_axes(draw: Draw) -> Mapping[str, Any]:
    axes = np.concatenate((np.eye(3), -np.eye(3)))
    return {"normal": axes[draw.rng.integers(0, 6, draw.n)].T}


def _floor(draw: Draw) -> Mapping[str, Any]:
    return {"normal": np.repeat(np.eye(3)[:, 2:], draw.n, axis=1)}


def _cosine(a: Arguments, r: Array) -> Array:
    return dot(r, a.normal)


def _by_solid_angle(a: Arguments, r: Array) -> Array:
    """Squared cosine and turn: uniform where the density is cos / pi."""
    return np.stack((np.clip(_cosine(a, r), 0, 1) ** 2, turn_about(a.normal, r)))


def _density(name: str, normals: str, **how: Any) -> Law:
    return uniform(
        name,
        f"Directions have the density cos / pi about {normals}",
        _by_solid_angle,
        (16, 16),
        "With the density cos / pi the squared cosine is uniform from 0 to 1, and so is the turn.",
        what="squared cosine and turn",
        **how,
    )


def _from_above(a: Arguments, r: Array) -> Array:
    """(2, N) places in the unit disk, seen along the normals."""
    squared, turn = _by_solid_angle(a, r)
    return np.asarray(np.sqrt(1 - squared) * (np.cos(2 * pi * turn), np.sin(2 * pi * turn)))


DIFFUSE_BOUNCE = function(
    "path_tracing.diffuse_bounce",
    {"normal": declare.directions()},
    (
        laws.within(
            "hemisphere",
            "Directions are on the normal's side",
            _cosine,
            0,
            1.001,
            "The hemisphere is the one about each path's own normal.",
            what="a cosine with the normal",
        ),
        laws.close(
            "poles",
            "Directions are right about normals along the axes, and for numbers at the ends of [0, 1)",
            lambda a, r: (
                np.stack((np.linalg.norm(r, axis=0), np.minimum(_cosine(a, r), 0))),
                np.array([[1.0], [0.0]]),
            ),
            "Is there a normal for which your basis breaks down?",
            what="length (row 0), or what is below the surface (1):",
            within=1e-5 / laws.EPSILON,
            case=_steep,
        ),
        cornered(_density("axes", "normals along the axes", case=_along_axes)),
        _density("density", "every normal", whole=True, picture=_from_above),
        smooth(10.0),
        evenly(lambda _, r: r[2] + 0.3 * r[0] + 0.2 * r[1], 2 / 3, case=_floor),
    ),
    free=True,
    features=lambda a, r: np.stack((_cosine(a, r), np.round(np.linalg.norm(r, axis=0), 3), *r)),
)


# ---------------------------------------------------------------- throughput


COLORS = Made(
    lambda d: d.uniform(0.02, 1, 3, d.n),
    corners=np.array([(0, 0, 0), (1e-6, 0, 0), (1, 1, 1), (0, 1e-3, 1e3)]).T.astype,
)
"""(3, N) numbers from 0 to 1, black and bright ones at the ends."""


def _of_any_size(draw: Draw) -> Mapping[str, Any]:
    """Much light, little and none, and albedos of which some are over 1."""
    sizes = draw.rng.choice((0, 1e-6, 1, 1e2, 1e5), (3, draw.n))
    return {
        "beta": sizes * draw.uniform(1, 8, 3, draw.n),
        "albedo": draw.uniform(0.1, 2, 3, draw.n),
    }


def _returned(a: Arguments, r: Array) -> tuple[Any, ...]:
    """Each channel to its own last places."""
    return r, a.beta * a.albedo, a.beta * a.albedo


THROUGHPUT = function(
    "path_tracing.throughput",
    {"beta": COLORS, "albedo": COLORS},
    (
        laws.close(
            "any-size",
            "Throughputs over 1, and next to 0, lose the same share as others, and none stays none",
            _returned,
            "After a roulette a throughput may be over 1: it is multiplied like any other, nothing is cut off.",
            what="a throughput of",
            case=_of_any_size,
        ),
        laws.close(
            "values",
            "What is left is f cos / pdf of it",
            _returned,
            "Write down f cos / pdf: what of it is left?",
            what="a throughput of",
            role="core",
        ),
    ),
    corners=(
        lambda _: {"albedo": np.ones((3, 5)), "beta": np.full((3, 5), 0.5)},
        lambda _: {"albedo": np.full((3, 5), 0.5), "beta": np.zeros((3, 5))},
    ),
)


# ---------------------------------------------------------------- russian_roulette


def _chance(beta: Array) -> Array:
    return np.asarray(np.minimum(beta.max(axis=0), 1))


def _apart(draw: Draw, beta: Array) -> Mapping[str, Any]:
    """Throughputs, and numbers that come near to no chance."""
    numbers = draw.units(1)[0].astype(np.float64)
    near = np.abs(numbers - _chance(beta)) < 2 * HAIR
    return {"beta": beta, "u": np.where(near, numbers / 2, numbers)}


def _games(draw: Draw) -> Mapping[str, Any]:
    """Any of the channels is the largest."""
    return _apart(draw, draw.uniform(0.02, 1, 3, draw.n))


def _sure(draw: Draw) -> Mapping[str, Any]:
    """A channel of each path is 1 or more."""
    beta = draw.uniform(0.02, 1, 3, draw.n)
    beta[draw.rng.integers(0, 3, draw.n), np.arange(draw.n)] = 1 + draw.lengths(0, 4, draw.n)
    return _apart(draw, beta)


def _dark(draw: Draw) -> Mapping[str, Any]:
    """Little light or none, and every other number 0."""
    beta = 1e-5 * draw.uniform(0.1, 1, 3, draw.n)
    beta[:, 2::4], beta[:, 3::4] = 0, 0
    numbers = 0.01 + 0.9 * draw.units(1)[0].astype(np.float64)
    numbers[::2] = 0
    return {"beta": beta, "u": numbers}


def _at_the_chance(draw: Draw) -> Mapping[str, Any]:
    """Largest channels that are eighths, and the same numbers."""
    chance = draw.rng.integers(1, 8, draw.n) / 8
    return {"beta": np.array([[1.0], [0.5], [0.25]]) * chance, "u": chance}


def _one_color(draw: Draw) -> Mapping[str, Any]:
    beta = draw.uniform(0.1, 0.9, 3, 1)
    return {"beta": np.repeat(beta, draw.n, axis=1)}


def _survives(a: Arguments, r: Any) -> Array:
    return np.asarray(r[0] == (a.u < _chance(a.beta)))


def _after(a: Arguments, r: Any) -> tuple[Any, ...]:
    """Throughputs after the game; those of survivors are known to the probability's last places."""
    q = _chance(a.beta)
    expected = np.where(a.u < q, a.beta / np.where(q > 0, q, 1), 0)
    return r[1], expected, expected.max(axis=0)


def _averages(a: Arguments, r: Any) -> list[tuple[str, Array, float, float]]:
    color = a.beta[:, 0]
    variance = color**2 * (1 / color.max() - 1)
    names = ("red", "green", "blue")
    return [
        (f"mean throughput in {name}", *of)
        for name, *of in zip(names, r[1], color.tolist(), variance.tolist(), strict=True)
    ]


RUSSIAN_ROULETTE = function(
    "path_tracing.russian_roulette",
    {},
    (
        laws.holds(
            "survival",
            "Paths survive as probably as their largest channel says",
            _survives,
            "a path to survive if u is less than its largest channel",
            "The probability is the largest channel, and at most 1.",
        ),
        laws.close(
            "certain",
            "Bright paths survive, and stay as they are",
            lambda a, r: (
                np.stack((r[0], *r[1])),
                np.stack((np.ones(r[0].shape), *a.beta)),
                a.beta.max(axis=0),
            ),
            "A probability is at most 1.",
            what="a bright path to survive (row 0 is 1) as it was (rows 1 to 3):",
            case=_sure,
            scales=(1.0, 1e3),
        ),
        laws.holds(
            "border",
            "A number that is just the probability ends the path",
            _survives,
            "a path to survive if u is less than its largest channel, and not if it is as large",
            "Less than: that is a plain <.",
            case=_at_the_chance,
        ),
        laws.holds(
            "dark",
            "Of little light little survives, of none nothing",
            lambda a, r: _survives(a, r) & (np.abs(r[1] - _after(a, r)[1]) <= 1e-5).all(axis=0),
            "a path that brings nothing to end, and one that brings little to survive where u is 0",
            "Nothing is certain to end, even where u is 0.",
            case=_dark,
        ),
        cornered(
            means(
                "mean",
                "The mean stays what it was",
                _averages,
                "On average the roulette must change nothing.",
                comparisons=3,
                case=_one_color,
            )
        ),
        laws.close(
            "values",
            "Survivors stand for the others, who bring nothing",
            _after,
            "Who survives stands for those who don't; who doesn't brings nothing.",
            what="a throughput of",
            role="core",
        ),
    ),
    case=_games,
    corners=(lambda _: {"beta": np.zeros((3, 5)), "u": np.full(5, 0.5)},),
)

FUNCTIONS = (DIFFUSE_BOUNCE, THROUGHPUT, RUSSIAN_ROULETTE)
