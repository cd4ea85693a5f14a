"""sampling declared: points on a disk, in a ball and on a sphere, and the generator xorshift32."""

from math import pi, sqrt
from typing import Any

import numpy as np
from scipy.special import ndtri

from course.school.grading.checks.check import Array, Failure, Trial
from course.school.grading.checks.declare import Arguments, Function, Law, Made, function
from course.school.grading.checks.distributions import FALSE_FAIL, MANY
from course.school.grading.checks.drawing import Draw
from course.school.grading.checks.laws import close, from_generator, holds, law
from course.school.grading.modules.generators import drawn
from course.school.grading.modules.round_shapes import (
    BALL,
    DISK,
    SPHERE,
    RoundShape,
    edge,
    moments,
    seen,
    uniform_over,
    unit_points,
)

# ---------------------------------------------------------------- rejection

ACCEPTED = {2: pi / 4, 3: pi / 6}
"""Share of the square or cube that the disk or ball takes up."""

MOST = 16
"""Times as many candidates as are needed may be drawn."""


def _candidates(points: Array, words: int) -> float:
    """How many points of the square or cube so many 64-bit numbers make."""
    # One makes two coordinates of single precision, and those are whole multiples of 2^-23.
    single = bool((points * 2**23 % 1 == 0).all())
    return words * (2 if single else 1) / len(points)


def _least(rows: int, n: int) -> float:
    """Fewer candidates than that give n points with probability FALSE_FAIL."""
    p = ACCEPTED[rows]
    return n / p + float(ndtri(FALSE_FAIL)) * sqrt(n * (1 - p)) / p


SEED = 8
"""Numbers that seed another generator, at the most."""


def _acceptance(rows: int) -> Law:
    def run(function: Function, trial: Trial) -> None:
        rng = trial.generator()
        before = rng.bit_generator.state
        value, (_, after), _ = trial.caller.call_and_look(function.name, MANY, rng)
        points = function.seen(value, Arguments(n=MANY, rng=rng))
        numbers = drawn(before, after.bit_generator.state)
        if 0 < numbers <= SEED:
            return  # A generator of its own draws the rest, which nobody here can count.
        found = _candidates(points, numbers)
        least, most = _least(rows, MANY), MOST * MANY / ACCEPTED[rows]
        if not least <= found <= most:
            raise Failure(
                f"{least:.0f} to {most:.0f} candidates drawn for {MANY} points, since"
                f" {ACCEPTED[rows]:.4f} of them are accepted",
                f"as many numbers as {found:.0f} candidates take",
                f"{function.name}(n = {MANY}, rng = a generator)",
                "Points of the square or cube are drawn from rng, and others for those outside.",
            )

    title = f"As many candidates are drawn as pi / {4 if rows == 2 else 6} of them accepted takes"
    return Law("acceptance", title, run, "corner", "distribution", 2.0, FALSE_FAIL)


def _any_count(rows: int) -> Law:
    """A supply that is enough on average runs out now and then, of few points oftener than of many."""

    def run(function: Function, trial: Trial) -> None:
        for n in np.geomspace(1, 200, SUPPLIES).astype(int).tolist():
            a = Arguments(n=n, rng=trial.generator())
            points = function.call(trial, a)
            differ = np.unique(points, axis=1).shape[1]
            if differ < n or not np.abs(points).sum(axis=0).all():
                raise Failure(
                    f"{n} points of their own",
                    f"{differ} that differ" if differ < n else "one at the centre",
                    f"{function.name}(n = {n}, rng = a generator)",
                    "What is missing when the candidates are used up is drawn anew.",
                )

    title = "However many points are asked for, all are drawn"
    # Two points of single precision are the same, or one is the centre.
    chance = SUPPLIES * 200**2 * 2.0 ** (-24 * rows)
    return Law("supply", title, run, "corner", "property", false_fail=chance)


SUPPLIES = 120
"""Calls, for 1 to 200 points each."""


def _habits(a: Arguments, points: Array) -> Array:
    """What mistakes show in: the points, how many there are and differ, and how many candidates it took, if counted."""
    rows = len(points)
    there, differ = (round(each.shape[1] / a.n, 1) for each in (points, np.unique(points, axis=1)))
    numbers = a.get("rng_drawn", 0)
    found = _candidates(points, numbers)
    drew = 2.0 if found >= _least(rows, a.n) else np.sign(numbers) / 2 + round(found / a.n, 1) / 2
    kinds = np.array([[there], [differ], [drew]])
    return np.concatenate((seen(points), np.repeat(kinds, points.shape[1], axis=1)))


def _by_rejection(shape: RoundShape, rows: int) -> Function:
    """A shape's points, as many as are asked for."""
    return function(
        f"sampling.{shape.name}_by_rejection",
        {"n": Made(lambda d: d.n, (-1, -100))},
        (
            edge(shape, dtypes=(np.float32,)),
            _acceptance(rows),
            _any_count(rows),
            from_generator(),
            moments(shape),
            uniform_over(shape),
        ),
        features=_habits,
    )


# ---------------------------------------------------------------- xorshift32

MARSAGLIA = (2463534242, 723471715, 2497366906, 2064144800)
"""The state that Marsaglia's paper starts with, and those that follow."""

SHARE = 2.0**-32
"""Of a state, in the random number."""

LAST = np.array((1584200935, 2899933646, 2969065140, 1246598047), np.uint32)
"""Next to these come states from 2^32 - 1 down: what is nearest to their share in single precision is 1."""

ENDS = np.array((0, 1, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF), np.uint32)


def _states(draw: Draw) -> Array:
    low, high = (1, 10) if draw.simple else (0, 1 << 32)
    return draw.rng.integers(low, high, draw.n, dtype=np.uint32)


def _stepped(state: Array) -> Array:
    """The next states, by whole numbers of 64 bits that are cut off after each shift."""
    state = state.astype(np.int64)
    state = (state ^ (state << 13)) & 0xFFFFFFFF
    state ^= state >> 17
    return np.asarray((state ^ (state << 5)) & 0xFFFFFFFF)


def _check_states(new: Array, expected: Array, state: Array) -> None:
    off = np.flatnonzero(new != expected)
    if off.size:
        k = int(off[0])
        raise Failure(
            f"the next state {expected[k]}",
            f"{new[k]}",
            f"state = {state[k]}",
            "Each of the three lines uses what the line before has left, in 32 bits.",
        )


def _known(function: Function, trial: Trial) -> None:
    state = np.array(MARSAGLIA[:1], np.uint32)
    for expected in MARSAGLIA[1:]:
        new, _ = function.call(trial, Arguments(state=state))
        _check_states(new, np.array([expected]), state)
        state = new.astype(np.uint32)


def _streams(a: Arguments, r: Any) -> None:
    new, random = r
    expected = _stepped(a.state)
    _check_states(new, expected, a.state)
    off = np.abs(random - expected * SHARE)
    if off.size and not off.max() <= 2.0**-23:
        k = int(off.argmax())
        raise Failure(
            f"random = new state / 2^32 = {expected[k] * SHARE:.7g}",
            f"{random[k]:.7g}",
            f"state = {a.state[k]}, new state = {new[k]}",
        )


XORSHIFT = function(
    "sampling.xorshift32",
    {
        "state": Made(
            _states,
            tuple(np.arange(1, 5, dtype=kind) for kind in ("i4", "i8", "u8", "f4")),
            lambda _: ENDS,
        )
    },
    (
        Law(
            "known",
            "From 2463534242 come the numbers that Marsaglia's generator is known for",
            _known,
        ),
        law(
            "ends",
            "The smallest and the largest states take their steps",
            _streams,
            case=lambda _: {"state": ENDS.copy()},
            dtypes=(np.float32,),
        ),
        close(
            "random",
            "The random number is the new state as a share of 2^32",
            lambda _, r: (r[1], r[0] * SHARE, 1.0),
            "An unsigned number of 32 bits has 2^32 values; it is the new one that counts, to 24 bits.",
            what="the new state / 2^32 =",
            within=0.75,  # 2^-24, and what is rounded
            dtypes=(np.float32,),
        ),
        holds(
            "below-one",
            "No random number is 1",
            lambda _, r: (r[1] < 1) & (r[1] > 1 - 2.0**-22),
            "random numbers next to 1, and below it",
            "The largest state stands for the largest number below 1.",
            shows=lambda _, r: r[1],
            case=lambda _: {"state": LAST.copy()},
            dtypes=(np.float32,),
            points=0.5,
        ),
        law(
            "streams", "Each stream takes its own step", _streams, dtypes=(np.float32,), role="core"
        ),
    ),
)

FUNCTIONS = (
    _by_rejection(DISK, 2),
    unit_points("sampling.disk_by_polar", DISK),
    _by_rejection(BALL, 3),
    unit_points("sampling.ball_by_polar", BALL),
    unit_points("sampling.sphere_by_polar", SPHERE),
    XORSHIFT,
)
