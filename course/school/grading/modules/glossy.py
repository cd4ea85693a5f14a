"""glossy declared: the basis about a direction, the lobes of square, ball and Phong, and the mirroring.

A right function may turn or mirror its square, use the rows of u in any order and sense, and choose any basis, so
all that is looked at is what stays the same whatever it chose.
"""

from collections.abc import Mapping
from functools import partial
from math import nan
from typing import Any

import numpy as np

from course.school.grading.checks import declare, laws
from course.school.grading.checks.check import Array
from course.school.grading.checks.declare import Arguments, Case, Function, Law, Made, function
from course.school.grading.checks.distributions import uniform
from course.school.grading.checks.drawing import Draw, worst_directions
from course.school.grading.checks.evenness import evenly, smooth
from course.school.grading.checks.vectors import cross, dot, normalized, turn_about
from course.school.grading.modules.round_shapes import cornered
from course.school.grading.modules.squares import no_jitter, square

UNIT = 1e-5 / laws.EPSILON
"""What unit vectors may be off by, in units in the last place."""

SEVERAL = (1.0,) * 4
"""Scales of a law without lengths: each makes other numbers."""


def _poles(draw: Draw, n: int | None = None) -> Array:
    """Directions along and around the axes, and at the equator."""
    ends = worst_directions(draw.dtype)
    return np.asarray(ends[:, draw.rng.integers(0, ends.shape[1], draw.n if n is None else n)])


def _one(draw: Draw) -> Mapping[str, Any]:
    """The same direction in all columns."""
    return {"direction": np.repeat(draw.directions(1), draw.n, axis=1)}


def _one_pole(draw: Draw) -> Mapping[str, Any]:
    return {"direction": np.repeat(_poles(draw, 1), draw.n, axis=1)}


def _up(draw: Draw) -> Mapping[str, Any]:
    return {"direction": np.repeat(np.eye(3)[:, 2:], draw.n, axis=1)}


def _chord(a: Arguments, r: Array) -> Array:
    """From each direction's tip to that of its result."""
    return np.asarray(np.linalg.norm(r - normalized(a.direction), axis=0))


def _seen(a: Arguments, r: Array) -> Array:
    """What shows most mistakes, rounding apart: how far directions went, where to, and their lengths."""
    moved = normalized(r - normalized(a.direction))
    length = np.round(np.linalg.norm(r, axis=0), 3)
    return np.stack((_chord(a, r), _cosine(a, r), length, *r, *moved))


def _cosine(a: Arguments, r: Array) -> Array:
    return dot(r, normalized(a.direction))


# ---------------------------------------------------------------- orthonormal_basis


def _easy(draw: Draw) -> Mapping[str, Any]:
    """Directions that no basis has trouble with."""
    w = draw.directions()
    return {"w": np.where(w[2] < -0.9, -w, w)}


def _products(a: Arguments, r: Any) -> Array:
    """Lengths, and products that are 0 at right angles."""
    (first, second), w = r, normalized(a.w)
    return np.stack(
        (
            np.linalg.norm(first, axis=0),
            np.linalg.norm(second, axis=0),
            dot(first, second),
            dot(first, w),
            dot(second, w),
        )
    )


def _orthonormal(name: str, title: str, hint: str, **how: Any) -> Law:
    return laws.close(
        name,
        title,
        lambda a, r: (_products(a, r), np.array([1, 1, 0, 0, 0])[:, None]),
        hint,
        what="of |u|, |v|, dot(u, v), dot(u, w), dot(v, w) = 1, 1, 0, 0, 0 one of",
        within=UNIT,
        **how,
    )


ORTHONORMAL_BASIS = function(
    "glossy.orthonormal_basis",
    {"w": declare.directions()},
    (
        _orthonormal(
            "orthonormal",
            "u, v and w are unit length and at right angles",
            "u and v are unit vectors for every w, and all three are at right angles.",
            role="core",
        ),
        laws.close(
            "right_handed",
            "The basis is right-handed: cross(u, v) = w",
            lambda a, r: (cross(*r), normalized(a.w), 1.0),
            "In a right-handed basis the cross product of the first two is the third.",
            what="cross(u, v) = w:",
            within=2 * UNIT,
        ),
        _orthonormal(
            "poles",
            "The basis holds along every axis and next to it",
            "Is there a w for which two vectors are parallel, or a divisor 0 or nearly so?",
            case=lambda d: {"w": _poles(d)},
            n=4000,
        ),
    ),
    contract="w: 3 N -> u: 3 N, v: 3 N",
    case=_easy,
    features=lambda a, r: np.round(_products(a, r), 3),
    scales=(),
)


# ---------------------------------------------------------------- the lobes


def _lobe(name: str, size: dict[str, Made], own: tuple[Law, ...]) -> Function:
    """A function that jitters directions: its conventions, and what every lobe keeps."""
    return function(
        f"glossy.{name}",
        {"direction": declare.directions(), **size},
        (laws.unit_length(), *own),
        free=True,
        features=_seen,
        scales=(),
    )


def _of_any_size(a: Arguments, r: Array) -> tuple[Any, ...]:
    radii = a.roughness * np.linalg.norm(a.u - 0.5, axis=0)
    return _chord(a, r), np.sqrt(2 * (1 - 1 / np.sqrt(1 + radii**2))), 1.0


JITTER_ON_PLANE = _lobe(
    "jitter_on_plane",
    {"roughness": declare.number(0.3, 2, (-1.0, -1e-6, nan))},
    (
        no_jitter("roughness"),
        square(
            "square",
            "The jitter is a square of side roughness around the direction, at right angles to it",
            case=_one,
            scales=SEVERAL,
            whole=True,
        ),
        laws.close(
            "extremes",
            "Very small and very large squares are as wide as they should be",
            _of_any_size,
            "The sides are as long as roughness, however small or large that is.",
            what="from the direction's tip to the result's,",
            case=lambda d: {"roughness": float(10.0 ** d.rng.choice((-6, -4, -2, 1, 3, 6)))},
            scales=SEVERAL * 3,
        ),
        square(
            "poles",
            "The square is right about directions along every axis and next to it",
            "Is there a direction for which your basis breaks down?",
            case=_one_pole,
            scales=SEVERAL * 2,
        ),
    ),
)


def _by_volume(a: Arguments, r: Array) -> Array:
    """The share of the ball within each cone, and the turn; where the ball ends, 1.

    A cone of cos(alpha) = c leaves the share c w^3 / g^3 of the ball outside, w^2 = c^2 - (1 - g^2): the integral
    of the ball's extent along each ray, (t1^3 - t0^3) / 3 with t = c +- w, over the ball's volume.
    """
    h, g = _chord(a, r) ** 2 / 2, a.glossiness
    outside = (1 - h) * np.maximum(g**2 - h * (2 - h), 0) ** 1.5 / g**3
    return np.stack((1 - outside, turn_about(a.direction, r)))


def _at_an_end(name: str, title: str, low: float, high: float, *, wide: bool) -> Law:
    """How far points of a ball lie off the axis, where glossiness, or what it is less than 1, is so small."""
    ends = uniform(
        name,
        title,
        lambda a, r: _by_volume(a, r)[:1],
        (24,),
        "No ball is too small, and none too large, to be jittered by.",
        what="share of the ball's volume within each direction",
        case=lambda d: {**_one(d), "glossiness": abs(wide - d.number(low, high))},
    )
    return cornered(ends)


JITTER_IN_BALL = _lobe(
    "jitter_in_ball",
    {"glossiness": declare.number(0.15, 0.95, (-1.0, -1e-6, nan, 1.0, 1.5))},
    (
        no_jitter("glossiness"),
        laws.holds(
            "cone",
            "No direction leaves the cone around the ball",
            lambda a, r: _chord(a, r) <= 2 * np.sin(np.arcsin(a.glossiness) / 2) + 2e-5,
            "a direction through the ball of radius glossiness",
            "Is each point inside the ball, and glossiness its radius?",
            case=lambda d: {"glossiness": 1 - d.number(0.001, 0.999999)},
            scales=SEVERAL * 2,
        ),
        smooth(10.0, case=lambda _: {"glossiness": 0.5}),
        # A unit vector's Laplacian is -2 of it over the squared distance: a ball's mean is 1 - glossiness^2 / 5.
        evenly(
            lambda _, r: r[2] + 0.3 * r[0] + 0.2 * r[1],
            1 - 0.9**2 / 5,
            case=lambda d: {**_up(d), "glossiness": 0.9},
        ),
        _at_an_end("narrow", "Small balls are filled as they should be", 0.002, 0.03, wide=False),
        _at_an_end(
            "wide", "Balls that nearly hold the origin are filled, too", 0.001, 0.03, wide=True
        ),
        uniform(
            "uniform",
            "Points are uniform over the ball's volume",
            _by_volume,
            (12, 12),
            "Does every part of the ball get its share of points?",
            what="share of the ball's volume within each direction, and turn",
            case=_one,
            draws=2,
            whole=True,
        ),
    ),
)


# ---------------------------------------------------------------- sample_phong_lobe


def _by_share(a: Arguments, r: Array) -> Array:
    """The share of the lobe within each alpha, 1 - cos^(exponent + 1), and the turn."""
    h = np.minimum(_chord(a, r) ** 2 / 2, 1 - 1e-12)
    share = -np.expm1((a.exponent + 1) * np.log1p(-h))
    return np.stack((share, turn_about(a.direction, r)))


def _density(name: str, title: str, low: float, high: float, case: Case = _one) -> Law:
    """The lobe's distribution, for exponents of that range."""
    return uniform(
        name,
        title,
        _by_share,
        (12, 12),
        "Integrate the density over the cone of alpha: which angle has the share u within?",
        what="share of the lobe within each direction, and turn",
        case=lambda d: {**case(d), "exponent": d.number(low, high) if high else 0.0},
        n=20_000 if case is _one else 10_000,
        whole=True,
        picture=_in_disk,
    )


def _in_disk(a: Arguments, r: Array) -> Array:
    """(2, N) points that fill the unit disk evenly if the lobe is right."""
    share, turn = _by_share(a, r)
    phi = 2 * np.pi * turn
    return np.asarray(np.sqrt(np.abs(share)) * (np.cos(phi), np.sin(phi)))


SAMPLE_PHONG_LOBE = _lobe(
    "sample_phong_lobe",
    {"exponent": declare.number(0.5, 80, (-1.0, -1e-6, nan))},
    (
        laws.holds(
            "mirror",
            "Lobes of exponents from 10^5 to 10^6 are all but a mirror",
            # cos^(exponent + 1) is 1e-6 at the least, alpha^2 some -2 log(cos).
            lambda a, r: _chord(a, r) <= 1.1 * np.sqrt(2 * np.log(1e6) / a.exponent) + 1e-3,
            "a direction next to the axis",
            "The larger the exponent, the closer to a mirror.",
            case=lambda d: {"exponent": d.number(1e5, 1e6), "u": d.uniform(1e-6, 1 - 1e-6, 2, d.n)},
        ),
        _density("density", "Directions have the density of the lobe, around its axis", 0.5, 5),
        cornered(_density("flat", "Exponent 0 gives the uniform hemisphere", 0, 0)),
        cornered(_density("narrow", "Lobes of exponents to 10^4 have their density", 1e3, 1e4)),
        cornered(_density("poles", "The lobe is the same about each axis", 2, 20, _one_pole)),
        smooth(10.0),
        evenly(
            lambda _, r: r[2] + 0.3 * r[0] + 0.2 * r[1],
            13 / 14,
            case=lambda d: {**_up(d), "exponent": 12.0},
        ),
    ),
)


# ---------------------------------------------------------------- keep_above


def _sided(side: int) -> Case:
    """Normals anywhere, and directions above (1), below (-1) or on any side (0), none of them grazing.

    Of those below, some go straight down.
    """

    def case(draw: Draw) -> Mapping[str, Any]:
        n, d = draw.directions(), draw.directions()
        d = np.where(side * dot(d, n) < 0, -d, d)
        if side < 0:
            d[:, ::3] = -n[:, ::3]
        return {"direction": np.where(np.abs(dot(d, n)) < 1e-4, n * (side or 1), d), "normal": n}

    return case


def _grazing(draw: Draw) -> Mapping[str, Any]:
    """Directions a little above and a little below the surface."""
    n = draw.directions()
    along = normalized(cross(n, np.roll(n, 1, axis=0)))
    height = draw.rng.choice((-1, 1), draw.n) * 10.0 ** draw.uniform(-5, -1, draw.n)
    return {"direction": normalized(along + height * n), "normal": n}


def _mirrored(a: Arguments, r: Array) -> tuple[Any, ...]:
    below = np.minimum(dot(a.direction, a.normal), 0)
    return r, a.direction - 2 * below * a.normal, 1.0


_above = partial(laws.close, compare=_mirrored, what="a direction of")


KEEP_ABOVE = function(
    "glossy.keep_above",
    {"direction": declare.directions(), "normal": declare.directions()},
    (
        _above(
            "unchanged",
            "Directions above the surface come back as they were",
            hint="Nothing is to be done above the surface; the normal is on the outgoing side.",
            case=_sided(1),
            within=0,
        ),
        _above(
            "mirrored",
            "Directions below the surface are mirrored in it, straight down becomes straight up",
            hint="What is below is mirrored in the surface: it is as far above it afterwards.",
            case=_sided(-1),
        ),
        _above(
            "grazing",
            "Just above the surface directions stay, just below it they are mirrored",
            hint="Does the cosine's sign alone decide, a hundred thousandth from the surface, too?",
            case=_grazing,
        ),
        _above(
            "batch",
            "In one batch, directions above stay and directions below are mirrored",
            hint="Is each direction decided on by itself, with its own normal?",
            case=_sided(0),
            role="core",
            whole=True,
        ),
    ),
    scales=(),
)

FUNCTIONS = (ORTHONORMAL_BASIS, JITTER_ON_PLANE, JITTER_IN_BALL, SAMPLE_PHONG_LOBE, KEEP_ABOVE)
