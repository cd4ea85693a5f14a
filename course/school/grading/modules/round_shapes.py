"""Uniform points of the disk, the ball and the sphere: what is uniform about them, wherever they are and how large.

Points are looked at as offsets from the centre, in radii: (2, N) on the disk, (3, N) else.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.special import iv

from course.school.grading.checks.check import Array, Failure
from course.school.grading.checks.declare import Arguments, Case, Function, Law, function
from course.school.grading.checks.distributions import means, uniform
from course.school.grading.checks.evenness import evenly, smooth
from course.school.grading.checks.examples import where
from course.school.grading.checks.laws import law
from course.school.grading.checks.vectors import TINY

Offsets = Callable[[Arguments, Any], Array]
"""(arguments, results) -> the points as seen from the centre, in radii."""


def _of_the_unit(_: Arguments, points: Array) -> Array:
    """Those of a shape of radius 1 around the origin."""
    return points


FRAME = np.array([(0.8, 0.6, 0.0), (-0.36, 0.48, 0.8), (0.48, -0.64, 0.6)])
"""Axes that nobody builds a shape about: along these a cylinder or a wrong ring shows as well."""

TILTS = {2: np.array([0.6, -0.8]), 3: FRAME[1]}
"""Of length 1: the exponential of the points along them is a smooth function whose mean has a closed form.

No squared component is near 1 / 3, where it wouldn't show that points crowd towards poles or equator by little.
"""

NEAR = 1e-6
"""In radii: what is that near to the centre is at it, and in no direction."""

SLACK = 1e-5
"""In radii, for rounding of the centre and of what is added to it."""

STEEP = 10.0
"""Steps of u make at most so much larger steps of points at radius 1, for most u: 2 pi and what the root adds."""


@dataclass(frozen=True)
class RoundShape:
    """A round shape.

    Attributes
    ----------
    name : of it
    places : offsets -> rows that are uniform from 0 to 1, and independent
    what : those are called
    cells : of all of them together
    mean : of the exponential along a vector of length 1
    powers : of one coordinate and another, the means of x^2, x^4 and x^2 y^2
    hint : why points aren't uniform, to be thought about
    """

    name: str
    places: Callable[[Array], Array]
    what: str
    cells: tuple[int, ...]
    mean: float
    powers: tuple[float, float, float]
    hint: str


def turn(x: Array, y: Array) -> Array:
    """The angle of each point, from 0 to 1."""
    return np.asarray(np.arctan2(y, x) / (2 * np.pi) % 1)


def _length(offsets: Array) -> Array:
    return np.asarray(np.linalg.norm(offsets, axis=0))


def _turned(offsets: Array) -> tuple[Array, Array]:
    """Height along an axis, and turn about it, of points of the sphere."""
    x, y, z = FRAME @ offsets
    return np.asarray((z + 1) / 2), turn(x, y)


def _in_ball(offsets: Array) -> Array:
    length = _length(offsets)
    return np.stack((length**3, *_turned(offsets / np.maximum(length, TINY))))


DISK = RoundShape(
    "disk",
    lambda p: np.stack((_length(p) ** 2, turn(p[0], p[1]))),
    "r^2 and turn of the points",
    (16, 16),
    float(2 * iv(1, 1.0)),
    (1 / 4, 1 / 8, 1 / 24),
    "Does a ring get as many points as its share of the area, all the way round?",
)
BALL = RoundShape(
    "ball",
    _in_ball,
    "r^3, height over r and turn about a tilted axis of the points",
    (6, 6, 6),
    3 / np.e,
    (1 / 5, 3 / 35, 1 / 35),
    "Does a shell get as many points as its share of the volume, in every direction?",
)
SPHERE = RoundShape(
    "sphere",
    lambda p: np.stack(_turned(p)),
    "height and turn about a tilted axis of the points",
    (16, 16),
    float(np.sinh(1)),
    (1 / 3, 1 / 5, 1 / 15),
    "Slices of a sphere with the same height have the same area.",
)


def edge(shape: RoundShape, offsets: Offsets = _of_the_unit, **how: Any) -> Law:
    """Points of the sphere are one radius from the centre; others not more, and some nearly as much."""

    def look(a: Arguments, r: Any) -> None:
        distance = _length(offsets(a, r))
        off = np.abs(distance - 1) if shape is SPHERE else distance - 1
        worst = int(off.argmax()) if off.size else 0
        at = where(a, (worst,), distance.shape)
        expected = "a distance from the centre of " + (
            "1 radius" if shape is SPHERE else "1 radius at the most"
        )
        if off.size and not off[worst] <= SLACK:
            raise Failure(expected, f"{distance[worst]:.7g} radii", at, f"Is it a {shape.name}?")
        # None of a thousand uniform points is beyond 0.9: once in 10^90.
        if distance.size >= 1000 and not distance.max() > 0.9:
            raise Failure(
                "points that reach to the edge",
                f"{distance.max():.7g} radii at the most",
                at,
                "The radius goes from the centre to the edge.",
            )

    name, title = (
        ("radius", "Points lie on the surface")
        if shape is SPHERE
        else ("inside", f"Points lie in the {shape.name}, and reach to its edge")
    )
    return law(name, title, look, ends=True, **how)


def uniform_over(
    shape: RoundShape, offsets: Offsets = _of_the_unit, case: Case | None = None
) -> Law:
    """Points are uniform over the shape."""
    title = {"disk": "over the disk's area", "ball": "over the ball's volume"}
    return uniform(
        "uniform",
        f"Points are uniform {title.get(shape.name, 'over the sphere')}, each where its own u says",
        lambda a, r: shape.places(offsets(a, r)),
        shape.cells,
        shape.hint,
        what=shape.what,
        case=case,
        whole=True,
        # Of a sphere or a ball obliquely: from above, its upper half looks like all of it.
        picture=lambda a, r: FRAME[:2] @ p if len(p := offsets(a, r)) == 3 else p,
    )


def moments(shape: RoundShape, offsets: Offsets = _of_the_unit, case: Case | None = None) -> Law:
    """The coordinates' means, and those of their squares and products, are the shape's."""
    second, fourth, mixed = shape.powers
    names = "xy" if shape is DISK else "xyz"

    def values(a: Arguments, r: Any) -> Iterator[tuple[str, Array, float, float]]:
        points = offsets(a, r)
        for k, name in enumerate(names):
            x, following = points[k], (k + 1) % len(names)
            yield f"mean of {name}", x, 0, second
            yield f"mean of {name}^2", x * x, second, fourth - second**2
            yield f"mean of {name} {names[following]}", x * points[following], 0, mixed

    title = "Means, spread and correlation of the coordinates are those of the shape"
    hint = "Uniform points lie around the centre, and as far from it along each axis."
    return cornered(means("moments", title, values, hint, comparisons=3 * len(names), case=case))


def warps(
    shape: RoundShape,
    offsets: Offsets = _of_the_unit,
    case: Case | None = None,
    unit: Case | None = None,
) -> tuple[Law, ...]:
    """What holds of a shape whose points u decides.

    Parameters
    ----------
    case : of the uniform points
    unit : the same with radius 1, so that steps and means are those of the unit's shape
    """
    return (
        moments(shape, offsets, case),
        uniform_over(shape, offsets, case),
        smooth(STEEP, case=unit),
        evenly(lambda a, r: _smooth_values(shape, offsets(a, r)), shape.mean + 1, case=unit),
    )


def unit_points(path: str, shape: RoundShape) -> Function:
    """A function that makes a point of the unit's shape of each u; its axes may be exchanged."""
    return function(
        path,
        {},
        (edge(shape), *warps(shape)),
        free=True,
        symmetric=True,
        features=lambda _, r: seen(r),
    )


def _smooth_values(shape: RoundShape, offsets: Array) -> Array:
    """An exponential, and twice what is uniform of each point's distance or height: u to the 0.34 shows in its mean."""
    return np.asarray(np.exp(TILTS[len(offsets)] @ offsets) + 2 * shape.places(offsets)[0])


def cornered(law: Law, name: str = "", title: str = "") -> Law:
    """The same law where it is about a corner, which may give it another name and title."""
    told = name or law.name, title or law.title
    return replace(law, name=told[0], title=told[1], role="corner", points=1.0)


def seen(offsets: Array) -> Array:
    """What mistakes show in, whichever axis is whose: the distance, and both offsets and directions along three axes.

    Each axis is turned such that the mean along it isn't negative; those with larger coordinates come last.
    """
    rows = offsets * np.where(offsets.mean(axis=1) < 0, -1, 1)[:, None]
    rows = rows[np.argsort(rows.mean(axis=1) + (rows**2).mean(axis=1))]
    length = _length(offsets)
    return np.stack((length, *rows, *np.where(length > NEAR, rows / (length + TINY), 0)))
