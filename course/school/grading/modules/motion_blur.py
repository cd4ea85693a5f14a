"""motion_blur declared: times while the shutter is open, and rays as a moving object sees them."""

from collections.abc import Mapping
from functools import partial
from math import inf, nan
from typing import Any

import numpy as np

from course.school.grading.checks import declare
from course.school.grading.checks.check import Array, Trial
from course.school.grading.checks.declare import Arguments, Made, function
from course.school.grading.checks.drawing import Draw
from course.school.grading.checks.evenness import evenly
from course.school.grading.checks.laws import close

SCALES = (1.0, 1e-3, 1e3)
"""Of times of the shutter, of velocities and of origins."""

# ---------------------------------------------------------------- shutter_times


def _shutter(draw: Draw) -> Mapping[str, Any]:
    """A shutter that opens neither at 0 nor a whole second before it closes, at times of either sign."""
    first = draw.number(0.3, 2) * draw.rng.choice((-1, 1))
    return {"open": draw.scale * first, "close": draw.scale * (first + draw.number(1.2, 2.5))}


def _instant(draw: Draw) -> Mapping[str, Any]:
    return dict.fromkeys(("open", "close"), draw.scale * draw.uniform(-3, 3).item())


def _others(draw: Draw) -> Mapping[str, Any]:
    """Open before time 0 and closed after it, or for thousandths of a second long after it; one u is 0."""
    u = draw.units(1)[0] * (np.arange(draw.n) < max(1, draw.n - 1))
    if draw.rng.random() < 0.5:
        return {
            "open": -draw.scale * draw.number(0.3, 2),
            "close": draw.scale * draw.number(0.3, 2),
            "u": u,
        }
    first = draw.number(1, 9)
    return {"open": first, "close": first + draw.number(1e-3, 1e-2), "u": u}


def _longest(a: Arguments) -> float:
    """The largest time, whose last places the others are rounded to."""
    return float(max(abs(a.open), abs(a.close)))


def _moments(a: Arguments, r: Array) -> tuple[Any, ...]:
    return r, a.open + (a.close - a.open) * a.u, _longest(a)


def _histogram(trial: Trial, a: Arguments, r: Array) -> None:
    share = (r - a.open) / (a.close - a.open)
    trial.show("histogram", "Times, as a share of the exposure", yours=share, u=a.u)


SHUTTER_TIMES = function(
    "motion_blur.shutter_times",
    {"open": Made(wrong=(nan, -inf, {"open": 2.0, "close": 1.0})), "close": Made(wrong=(nan, inf))},
    (
        close(
            "instant",
            "A shutter that closes as it opens gives that moment",
            lambda a, r: (r, a.open),
            "With open = close every ray sees that one moment.",
            what="the time of a shutter that closes as it opens",
            within=4,
            case=_instant,
            scales=SCALES,
        ),
        close(
            "inside",
            "Times lie between open and close, in short exposures and around time 0 as well",
            _moments,
            "No ray may see the scene before the shutter opens or after it closes.",
            what="a time of",
            within=4,
            case=_others,
            scales=SCALES * 2,
        ),
        close(
            "uniform",
            "All moments of the exposure are equally probable: equal steps of u are equal steps of time",
            _moments,
            "All moments between open and close are equally probable, and they rise with u.",
            what="a time of",
            within=4,
            scales=SCALES,
            whole=True,
            figure=_histogram,
        ),
        evenly(lambda _, r: np.exp(r), float(np.e - 1), case=lambda _: {"open": 0.0, "close": 1.0}),
    ),
    case=_shutter,
)


# ---------------------------------------------------------------- displacement and to_object_space


def _velocity(draw: Draw) -> Array:
    """No component near 0, none like another, and a speed that is not 1."""
    if draw.simple:
        return draw.scale * np.array((2.0, -1.0, 4.0))
    sizes = draw.rng.permutation((0.7, 1.3, 2.1)) * draw.uniform(0.9, 1.1, 3)
    return np.asarray(draw.scale * sizes * draw.rng.choice((-1.0, 1.0), 3))


VELOCITY = Made(_velocity)
TIME = declare.values(-2.0, 3.0)


def _along_axes(draw: Draw) -> Mapping[str, Any]:
    """Objects that move along an axis, or in a plane of two of them."""
    return {"velocity": _velocity(draw) * draw.rng.permutation((1, int(draw.rng.integers(2)), 0))}


def _any_time(draw: Draw) -> Mapping[str, Any]:
    """From microseconds to weeks, of either sign, and none."""
    return {"time": draw.rng.choice((-1, 0, 1), draw.n) * np.geomspace(1e-6, 1e6, draw.n)}


def _way(a: Arguments) -> Array:
    return np.outer(a.velocity, a.time)


def _went(a: Arguments, r: Array) -> tuple[Any, ...]:
    return r, _way(a), np.abs(_way(a))


_gone = partial(close, compare=_went, what="the way gone, along an axis,", within=4, scales=SCALES)


DISPLACEMENT = function(
    "motion_blur.displacement",
    {"velocity": VELOCITY, "time": TIME},
    (
        _gone(
            "one-second",
            "In one second an object goes its velocity",
            hint="Velocity is the way gone in one second.",
            case=lambda d: {"time": np.ones(d.n)},
        ),
        _gone(
            "any-time",
            "Long and short times have their ways, before the start as well, and time 0 has none",
            hint="At a constant velocity twice the time is twice the way.",
            case=_any_time,
        ),
        _gone(
            "along-axes",
            "Objects that move along one axis or two go their way along these",
            hint="A component that is 0 says nothing of the others.",
            case=_along_axes,
        ),
        _gone(
            "linear",
            "Each ray gets the way of its own time",
            hint="At a constant velocity twice the time is twice the way; each ray has a time of its own.",
            whole=True,
        ),
    ),
)


def _stood(a: Arguments, r: Array) -> tuple[Any, ...]:
    return r, a.origins - _way(a), np.abs(a.origins) + np.abs(_way(a))


_seen = partial(close, compare=_stood, what="an origin's coordinate of", within=4, scales=SCALES)


def _unmoved(draw: Draw) -> Mapping[str, Any]:
    """An object that stands still at any time, or one that moves at time 0."""
    if draw.rng.random() < 0.5:
        return {"velocity": np.zeros(3), **_any_time(draw)}
    return {"time": np.zeros(draw.n)}


def _aboard(draw: Draw) -> Mapping[str, Any]:
    """Origins that stay at one place of the object."""
    velocity, time = _velocity(draw), draw.uniform(-2, 3, draw.n)
    place = draw.lengths(-3, 3, 3)
    return {
        "velocity": velocity,
        "time": time,
        "origins": place[:, None] + np.outer(velocity, time),
    }


TO_OBJECT_SPACE = function(
    "motion_blur.to_object_space",
    {"origins": declare.points(), "velocity": VELOCITY, "time": TIME},
    (
        _seen(
            "at-rest",
            "Rays are where they are seen beside an object that stands still, and at time 0",
            hint="What has gone no way sees every ray where it is; at time 0 nothing has moved yet.",
            case=_unmoved,
            scales=SCALES * 2,
        ),
        _seen(
            "travels-along",
            "What travels along with the object stays at one place of it",
            hint="Whoever travels along with the object stays at the same place of it.",
            what="a ray that starts on the object, seen from the object, at",
            case=_aboard,
        ),
        _seen(
            "along-axes",
            "Rays are moved by objects that move along one axis or two",
            hint="An object stands still only if all components of its velocity are 0.",
            case=_along_axes,
        ),
        _seen(
            "own-time",
            "Each ray is moved by the way of its own time",
            hint="The ray, less the way that the object has gone by the ray's own time.",
            # Whether the last places are kept near 0 is asked above.
            floor=1e-5,
            scales=(1.0, 1e3),
            whole=True,
        ),
    ),
)

FUNCTIONS = (SHUTTER_TIMES, DISPLACEMENT, TO_OBJECT_SPACE)
