"""Checks of the sampling module: points on a disk, in a ball and on a sphere, and the generator xorshift32.

Whether points are uniform is asked of coordinates that are then uniform in [0, 1]: r^2 and the turn on the disk; r^3,
the height over r and the turn in the ball; the height and the turn on the sphere.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from math import pi, sqrt
from typing import Any

import numpy as np
from scipy.special import ndtri

from course.grading.checks.check import Array, Check, Failure, Mistake, ModuleChecks, Trial
from course.grading.checks.contract import (
    DTYPES,
    at,
    check_array,
    check_refused,
    check_seeded,
    check_untouched,
    contract_checks,
    finite_floats,
    pair,
    worst_units,
)
from course.grading.checks.statistics import (
    CLOSE,
    FALSE_FAIL,
    apart,
    check_mean,
    check_uniform,
    distribution_check,
)

POINTS = 20_000
"""In a check of a distribution."""

ROWS = {
    "disk_by_rejection": 2,
    "disk_by_polar": 2,
    "ball_by_rejection": 3,
    "ball_by_polar": 3,
    "sphere_by_polar": 3,
}
"""Coordinates of a point."""

NUMBERS = {"disk_by_polar": 2, "ball_by_polar": 3, "sphere_by_polar": 2}
"""Rows of u."""

ACCEPTED = {2: pi / 4, 3: pi / 6}
"""Share of the square or cube that the disk or ball takes up."""


# ---------------------------------------------------------------- points


def _arguments(trial: Trial, n: int, dtype: Any = np.float32) -> tuple[Any, ...]:
    if trial.function in NUMBERS:
        return (trial.rng.random((NUMBERS[trial.function], n), dtype),)
    return n, trial.generator()


def _points(trial: Trial, n: int, dtype: Any = np.float32) -> Array:
    points = finite_floats(
        trial.call(*_arguments(trial, n, dtype)), (ROWS[trial.function], n), "the points"
    )
    trial.show("points", "your points, seen along z", yours=points[:2, :2000])
    return points


def _turn(points: Array) -> Array:
    return np.asarray(np.arctan2(points[1], points[0]) / (2 * np.pi) % 1)


def _height(points: Array) -> Array:
    """Where z lies between the bottom and the top of the sphere through each point."""
    r = np.maximum(np.sqrt((points * points).sum(axis=0)), 1e-200)
    return np.asarray(np.clip((points[2] / r + 1) / 2, 0, 1))


def _volume(points: Array) -> Array:
    """The share of the disk's area or of the ball's volume that is nearer to the centre."""
    r = np.sqrt((points * points).sum(axis=0))
    return np.asarray(np.clip(r ** len(points), 0, 1))


def _even(function: str, points: Array) -> dict[str, Array]:
    """The coordinates that are uniform for uniform points, by name."""
    turn = {"turn": _turn(points)}
    match function.partition("_")[0]:
        case "disk":
            return {"r^2": _volume(points)} | turn
        case "ball":
            return {"r^3": _volume(points), "z / r": _height(points)} | turn
    return {"z": _height(points)} | turn


def _points_contract(trial: Trial) -> None:
    rows = ROWS[trial.function]
    if trial.function not in NUMBERS:
        for n in (int(trial.rng.integers(2, 200)), 1, 0):
            check_array(trial.call(n, trial.generator()), (rows, n), np.float32, f"n = {n}: points")
        return
    for dtype in DTYPES:
        u = worst_units(NUMBERS[trial.function], dtype)
        for batch in (u, u[:, :1].copy(), u[:, :0].copy()):
            check_array(trial.call(batch), (rows, batch.shape[1]), dtype, "points")


def _points_untouched(trial: Trial) -> None:
    check_untouched(trial, *_arguments(trial, 50))


def _points_refuses(trial: Trial) -> None:
    if trial.function not in NUMBERS:
        for n in (-1, -100):
            check_refused(trial, n, trial.generator(), named=f"n ({n})")
        return
    rows = NUMBERS[trial.function]
    u = trial.rng.random((4, 5), np.float32)
    for bad in (u[: rows + 1], u[: rows - 1], u[0], u[:rows].T, u[None, :rows]):
        check_refused(trial, bad, named=f"u of shape {bad.shape}")


def _points_within(trial: Trial) -> None:
    for dtype in DTYPES:
        points = _points(trial, 5000, dtype)
        r = np.sqrt((points * points).sum(axis=0))
        worst = int(r.argmax())
        if not r[worst] <= 1 + 1e-6:
            raise Failure(
                "a distance from the centre of 1 at the most",
                f"{r[worst]:.7g}",
                at(point=points)(worst),
                "Points in the corners of the square or cube are outside.",
            )


def _sphere_unit(trial: Trial) -> None:
    for dtype in DTYPES:
        worst = worst_units(2, dtype)
        u = np.concatenate((worst, trial.rng.random((2, 5000), dtype)), axis=1)
        points = finite_floats(trial.call(u), (3, u.shape[1]), "the points")
        off = np.abs(np.sqrt((points * points).sum(axis=0)) - 1)
        column = int(off.argmax())
        if not off[column] <= 1e-5:
            raise Failure(
                "points of the sphere's surface: a length of 1 within 1e-5",
                f"1 off by {off[column]:.3g}",
                at(u=u)(column),
                "What a height leaves for the ring around it is told by Pythagoras.",
            )


def _points_uniform(trial: Trial) -> None:
    even = _even(trial.function, _points(trial, POINTS))
    for name, values in even.items():
        hint = "Does each part get as many points as its share of the area or volume?"
        check_uniform(values[None], (24,), f"{name} of the points", hint)
    check_uniform(
        np.stack([*even.values()]),
        (16, 16) if len(even) == 2 else (6, 6, 6),
        f"{' and '.join(even)} of the points together",
        "Each of the random numbers has to have a job of its own.",
    )


def _points_moments(trial: Trial) -> None:
    points = _points(trial, POINTS, np.float64)
    rows = len(points)
    # Of one coordinate on the disk, in the ball, on the sphere: the means of x^2, x^4 and x^2 y^2.
    second, fourth, mixed = {
        "disk": (1 / 4, 1 / 8, 1 / 24),
        "ball": (1 / 5, 3 / 35, 1 / 35),
        "sphere": (1 / 3, 1 / 5, 1 / 15),
    }[trial.function.partition("_")[0]]
    for k, name in enumerate("xyz"[:rows]):
        x = points[k]
        check_mean(x, 0, second, f"mean of {name}", "The shape lies around the origin.")
        spread = "The points reach as far, and are as dense, along each axis."
        check_mean(x * x, second, fourth - second**2, f"mean of {name}^2", spread)
        other = "xyz"[(k + 1) % rows]
        product = x * points[(k + 1) % rows]
        check_mean(product, 0, mixed, f"mean of {name} {other}", "Coordinates are not correlated.")


# ---------------------------------------------------------------- rejection

_MULTIPLIER = 0x2360ED051FC65DA44385DF649FCCF645
_WORD = 1 << 128


def _drawn(before: Any, after: Any) -> int:
    """64-bit numbers that a PCG64 generator gave between two of its states.

    Source: Brown, "Random number generation with arbitrary strides", 1994.
    """
    state, end, plus = before["state"]["state"], after["state"]["state"], before["state"]["inc"]
    factor, bit, steps = _MULTIPLIER, 1, 0
    while state != end and bit < _WORD:
        if (state ^ end) & bit:
            state = (state * factor + plus) % _WORD
            steps |= bit
        bit <<= 1
        plus = (factor + 1) * plus % _WORD
        factor = factor * factor % _WORD
    return steps


def _candidates(trial: Trial, n: int) -> tuple[float, Array]:
    """How many points of the square or cube a call has drawn, and the points that came of it."""
    rng = trial.generator()
    before = rng.bit_generator.state
    value, arguments, _ = trial.caller.call_and_look(trial.function, n, rng)
    points = finite_floats(value, (ROWS[trial.function], n), "the points")
    words = _drawn(before, arguments[1].bit_generator.state)
    # One 64-bit number makes two coordinates of single precision, and those are whole multiples of 2^-23.
    single = bool((points * 2**23 % 1 == 0).all())
    return words * (2 if single else 1) / len(points), points


def _least(rows: int, n: int) -> float:
    """Fewer candidates than that give n points with probability FALSE_FAIL."""
    p = ACCEPTED[rows]
    return n / p + float(ndtri(FALSE_FAIL)) * sqrt(n * (1 - p)) / p


def _rejection_rate(trial: Trial) -> None:
    found, points = _candidates(trial, POINTS)
    rows = len(points)
    trial.show("points", "your points, seen along z", yours=points[:2, :2000])
    least, most = _least(rows, POINTS), 16 * POINTS / ACCEPTED[rows]
    rate = f"pi / {4 if rows == 2 else 6} = {ACCEPTED[rows]:.4f}"
    if not least <= found <= most:
        raise Failure(
            f"{least:.0f} to {most:.0f} candidates drawn for {POINTS} points, since {rate} of them are accepted",
            f"as many numbers as {found:.0f} candidates take",
            hint="Draw points of the square or cube from rng, and draw others for those outside.",
        )


def _rejection_repeats(trial: Trial) -> None:
    shape = (ROWS[trial.function], 200)
    check_seeded(trial, lambda rng: finite_floats(trial.call(200, rng), shape, "the points"))


# ---------------------------------------------------------------- xorshift32

MARSAGLIA = 2463534242
"""The state that Marsaglia's paper starts with."""

SHIFTS = (13, -17, 5)


def _stepped(state: int, shifts: tuple[int, ...] = SHIFTS) -> int:
    """The next state by whole numbers of Python; a negative shift goes to the right."""
    for shift in shifts:
        moved = state << shift if shift > 0 else state >> -shift
        state = (state ^ moved) & 0xFFFFFFFF
    return state


def _states(trial: Trial, n: int) -> Array:
    return trial.rng.integers(1, 1 << 32, n, dtype=np.uint32)


def _step(trial: Trial, state: Array) -> tuple[Array, Array]:
    """The student's next states as whole numbers, and the random numbers."""
    new, random = pair(trial.call(state.copy()), "state", "random")
    kind = getattr(getattr(new, "dtype", None), "kind", "")
    if kind not in ("u", "i"):
        raise Failure("states that are whole numbers", f"dtype {getattr(new, 'dtype', type(new))}")
    check_array(new, state.shape, new.dtype, "the new state")
    return new.astype(np.int64), finite_floats(random, state.shape, "the random numbers")


def _xorshift_contract(trial: Trial) -> None:
    for state in (
        _states(trial, 100),
        np.array([0, 1, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF], np.uint32),
        np.array([MARSAGLIA], np.uint32),
        np.empty(0, np.uint32),
    ):
        new, random = pair(trial.call(state), "state", "random")
        check_array(new, state.shape, np.uint32, "the new state")
        check_array(random, state.shape, np.float32, "the random numbers")


def _xorshift_untouched(trial: Trial) -> None:
    check_untouched(trial, _states(trial, 50))


def _xorshift_refuses(trial: Trial) -> None:
    state = _states(trial, 4)
    for bad in (state[None], state.reshape(2, 2), state[0]):
        check_refused(trial, bad, named="state (its shape)")
    for dtype in (np.int32, np.int64, np.uint64, np.float32):
        check_refused(
            trial, (state >> np.uint32(1)).astype(dtype), named=f"state ({dtype.__name__})"
        )


def _check_states(found: Array, expected: list[int], state: Array, hint: str) -> None:
    off = np.flatnonzero(found != np.array(expected, np.int64))
    if off.size:
        k = int(off[0])
        raise Failure(f"the next state {expected[k]}", f"{found[k]}", f"state = {state[k]}", hint)


def _xorshift_known(trial: Trial) -> None:
    state = np.array([MARSAGLIA], np.uint32)
    for expected in (723471715, 2497366906, 2064144800):
        new, _ = _step(trial, state)
        hint = "Each of the three lines uses what the line before has left."
        _check_states(new, [expected], state, hint)
        state = new.astype(np.uint32)


def _xorshift_streams(trial: Trial) -> None:
    state = np.concatenate(([1, 0, 0x80000000], _states(trial, 200))).astype(np.uint32)
    for _ in range(3):
        new, _ = _step(trial, state)
        expected = [_stepped(int(s)) for s in state]
        _check_states(new, expected, state, "Every stream goes its own way, in 32 bits.")
        state = new.astype(np.uint32)


def _xorshift_random(trial: Trial) -> None:
    state = np.concatenate((_states(trial, 2000), [0xFFFFFFFF])).astype(np.uint32)
    new, random = _step(trial, state)
    expected = new / 2**32
    off = np.abs(random - expected)
    worst = int(off.argmax())
    if not off[worst] <= 2.0**-23:
        raise Failure(
            f"random = new state / 2^32 = {expected[worst]:.7g}",
            f"{random[worst]:.7g}",
            f"state = {state[worst]}, new state = {new[worst]}",
            "The largest state stands for the largest number below 1.",
        )


def _xorshift_uniform(trial: Trial) -> None:
    state = _states(trial, POINTS)
    state, first = _step(trial, state)
    _, second = _step(trial, (state & 0xFFFFFFFF).astype(np.uint32))
    hint = "The state that comes back is what the next call starts from."
    values = np.clip(np.stack((first, second)), 0, 1)
    check_uniform(values[:1], (24,), "the random numbers", hint)
    check_uniform(values, (16, 16), "two random numbers of a stream, one after the other", hint)


# ---------------------------------------------------------------- mistakes


Model = Callable[[Array], Array]


def _spread_as(trial: Trial, name: str, model: Model) -> bool:
    """One coordinate is spread as a mistaken warp of uniform numbers spreads it, the others evenly."""
    even = _even(trial.function, _points(trial, 4000))
    u = trial.rng.random(4000)
    return all(
        apart(values, model(u) if key == name else u) < CLOSE for key, values in even.items()
    )


def _radii(points: Array) -> Array:
    return np.asarray(np.sqrt((points * points).sum(axis=0)))


def _in_corners(trial: Trial) -> bool:
    points = _points(trial, 4000)
    uniform = trial.rng.random(4000)
    even = max(apart((x + 1) / 2, uniform) for x in points) < CLOSE
    return even and bool(_radii(points).max() > 1.2)


def _pushed_to_rim(trial: Trial) -> bool:
    """As many points as should have been rejected lie on the rim."""
    points = _points(trial, 4000)
    share = float((np.abs(_radii(points) - 1) < 1e-5).mean())
    return abs(share - (1 - ACCEPTED[len(points)])) < 0.05


def _one_quadrant(trial: Trial) -> bool:
    points = _points(trial, 1000)
    return bool(points.min() >= 0 and _radii(points).max() <= 1 + 1e-6)


def _too_few(trial: Trial) -> bool:
    value = trial.call(1000, trial.generator())
    if not isinstance(value, np.ndarray) or value.ndim != 2 or len(value) != ROWS[trial.function]:
        return False
    return bool(abs(value.shape[1] / 1000 - ACCEPTED[len(value)]) < 0.1)


def _nothing_rejected(trial: Trial) -> bool:
    found, points = _candidates(trial, 4000)
    even = _even(trial.function, points)
    u = trial.rng.random(4000)
    return found < _least(len(points), 4000) and all(apart(x, u) < CLOSE for x in even.values())


def _nothing_drawn(trial: Trial) -> bool:
    return _candidates(trial, 1000)[0] == 0


def _left_at_centre(trial: Trial) -> bool:
    points = _points(trial, 4000)
    share = float((points == 0).all(axis=0).mean())
    return abs(share - (1 - ACCEPTED[len(points)])) < 0.05


def _half_turn(trial: Trial) -> bool:
    points = _points(trial, 4000)
    turns = np.sort(_turn(points))
    gap = float(np.diff(np.concatenate((turns, turns[:1] + 1))).max())
    return 0.48 < gap < 0.52


def _on_surface(trial: Trial) -> bool:
    return bool(np.abs(_radii(_points(trial, 1000)) - 1).max() < 1e-3)


def _one_number(trial: Trial) -> bool:
    """A row of u makes no difference at all."""
    (u,) = _arguments(trial, 500)
    rows = ROWS[trial.function]
    found = finite_floats(trial.call(u), (rows, 500), "the points")
    for row in range(len(u)):
        other = u.copy()
        other[row] = trial.rng.random(500, np.float32)
        if np.array_equal(found, finite_floats(trial.call(other), (rows, 500), "the points")):
            return True
    return False


def _uniform_angle(u: Array) -> Array:
    """The height at an angle that is uniform from pole to pole."""
    return np.asarray((np.cos(np.pi * u) + 1) / 2)


def _state_is(trial: Trial, mistaken: Callable[[int], int]) -> bool:
    state = _states(trial, 50)
    new, _ = _step(trial, state)
    return [int(s) & 0xFFFFFFFF for s in new] == [mistaken(int(s)) for s in state]


def _from_one_state(state: int) -> int:
    """All three shifts of the state as it was."""
    return (state ^ (state << 13) ^ (state >> 17) ^ (state << 5)) & 0xFFFFFFFF


def _too_wide(trial: Trial) -> bool:
    state = np.array([MARSAGLIA], np.uint32)
    new, _ = pair(trial.call(state), "state", "random")
    return bool(new.dtype.itemsize > 4)


def _random_is(trial: Trial, mistaken: Callable[[Array, Array], Array]) -> bool:
    state = _states(trial, 500)
    new, random = _step(trial, state)
    return bool(np.abs(random - mistaken(state.astype(np.int64), new)).max() < 1e-6)


# ---------------------------------------------------------------- all of it


def _point_checks(function: str) -> tuple[Check, ...]:
    """What is asked of all five shapes."""
    shape = function.partition("_")[0]
    part = {"disk": "over the disk's area", "ball": "over the ball's volume"}
    within = (
        Check(function, "unit_length", "Points lie on the unit sphere", _sphere_unit)
        if shape == "sphere"
        else Check(function, "within", f"Points lie in the unit {shape}", _points_within)
    )
    return (
        *contract_checks(function, _points_contract, _points_untouched, _points_refuses),
        within,
        distribution_check(
            function,
            "uniform",
            f"Points are uniform {part.get(shape, 'over the sphere')}",
            _points_uniform,
            4 if shape == "ball" else 3,
        ),
        distribution_check(
            function,
            "moments",
            "Means, spread and correlation of the coordinates are those of the shape",
            _points_moments,
            3 * ROWS[function],
        ),
    )


def _rejection_checks(function: str) -> tuple[Check, ...]:
    return (
        *_point_checks(function),
        distribution_check(
            function,
            "acceptance",
            f"As many candidates are drawn as pi / {4 if ROWS[function] == 2 else 6} of them accepted takes",
            _rejection_rate,
            1,
        ),
        Check(
            function,
            "from_rng",
            "The generator alone decides which points come",
            _rejection_repeats,
        ),
    )


def _rejection_mistakes(function: str) -> tuple[Mistake, ...]:
    shape, box = ("disk", "square") if ROWS[function] == 2 else ("ball", "cube")
    return (
        Mistake(
            function,
            f"{shape}-not-rejected",
            f"Your points fill the whole {box}: those outside the {shape} are never rejected.",
            _in_corners,
        ),
        Mistake(
            function,
            f"{shape}-pushed-to-rim",
            f"Points outside the {shape} are moved to its rim instead of being drawn anew, so the rim is crowded.",
            _pushed_to_rim,
        ),
        Mistake(
            function,
            f"{shape}-left-at-centre",
            f"Where a point was rejected you leave the centre of the {shape} instead of drawing anew.",
            _left_at_centre,
        ),
        Mistake(
            function,
            f"{shape}-one-corner",
            f"All coordinates are positive: your {box} reaches from 0 to 1, not from -1.",
            _one_quadrant,
        ),
        Mistake(
            function,
            f"{shape}-too-few",
            "You draw n candidates and return those that are accepted: fewer than n.",
            _too_few,
        ),
        Mistake(
            function,
            f"{shape}-own-generator",
            "Nothing is drawn from rng: your random numbers come from elsewhere.",
            _nothing_drawn,
        ),
        Mistake(
            function,
            f"{shape}-no-rejection",
            "Your points are uniform, but you draw too few numbers to have rejected any: this is a warp.",
            _nothing_rejected,
        ),
    )


CHECKS = ModuleChecks(
    "sampling",
    checks=(
        *_rejection_checks("disk_by_rejection"),
        *_point_checks("disk_by_polar"),
        *_rejection_checks("ball_by_rejection"),
        *_point_checks("ball_by_polar"),
        *_point_checks("sphere_by_polar"),
        *contract_checks("xorshift32", _xorshift_contract, _xorshift_untouched, _xorshift_refuses),
        Check(
            "xorshift32",
            "known",
            "From 2463534242 come the numbers that Marsaglia's generator is known for",
            _xorshift_known,
        ),
        Check("xorshift32", "streams", "Each stream takes its own step", _xorshift_streams),
        Check(
            "xorshift32",
            "random",
            "The random number is the new state as a share of 2^32",
            _xorshift_random,
        ),
        distribution_check(
            "xorshift32",
            "uniform",
            "Random numbers of a stream are uniform, and so are pairs of them",
            _xorshift_uniform,
            2,
        ),
    ),
    mistakes=(
        *_rejection_mistakes("disk_by_rejection"),
        *_rejection_mistakes("ball_by_rejection"),
        Mistake(
            "disk_by_polar",
            "disk-crowded-centre",
            "Your points crowd the centre: a uniform radius is not uniform in area.",
            partial(_spread_as, name="r^2", model=lambda u: u**2),
        ),
        Mistake(
            "disk_by_polar",
            "disk-half-turn",
            "Your points stay on one half of the disk: the angle covers half a turn.",
            _half_turn,
        ),
        Mistake(
            "disk_by_polar",
            "disk-one-number",
            "One row of u has no effect: radius and angle each need a number of their own.",
            _one_number,
        ),
        Mistake(
            "ball_by_polar",
            "ball-square-root",
            "The radius follows the square root, which is right for the disk's area; a ball has a volume.",
            partial(_spread_as, name="r^3", model=lambda u: u**1.5),
        ),
        Mistake(
            "ball_by_polar",
            "ball-crowded-centre",
            "Your points crowd the centre: a uniform radius is not uniform in volume.",
            partial(_spread_as, name="r^3", model=lambda u: u**3),
        ),
        Mistake(
            "ball_by_polar",
            "ball-surface-only",
            "All your points lie on the surface: the radius is never drawn.",
            _on_surface,
        ),
        Mistake(
            "ball_by_polar",
            "ball-crowded-poles",
            "Your points crowd the poles: what is uniform is the height, not the angle from the pole.",
            partial(_spread_as, name="z / r", model=_uniform_angle),
        ),
        Mistake(
            "ball_by_polar",
            "ball-one-number",
            "One row of u has no effect: radius, height and turn each need a number of their own.",
            _one_number,
        ),
        Mistake(
            "sphere_by_polar",
            "sphere-crowded-poles",
            "Your points crowd the poles: what is uniform is the height, not the angle from the pole.",
            partial(_spread_as, name="z", model=_uniform_angle),
        ),
        Mistake(
            "sphere_by_polar",
            "sphere-upper-half",
            "Your points cover the upper half alone: the height runs from -1 to 1.",
            partial(_spread_as, name="z", model=lambda u: (u + 1) / 2),
        ),
        Mistake(
            "xorshift32",
            "wrong-way-shifts",
            "Your shifts go the wrong way: it is left by 13, right by 17, left by 5.",
            partial(_state_is, mistaken=lambda s: _stepped(s, (-13, 17, -5))),
        ),
        Mistake(
            "xorshift32",
            "other-order",
            "Your shifts are the right ones in another order.",
            lambda trial: any(
                _state_is(trial, partial(_stepped, shifts=order))
                for order in ((5, -17, 13), (-17, 13, 5), (13, 5, -17), (5, 13, -17), (-17, 5, 13))
            ),
        ),
        Mistake(
            "xorshift32",
            "all-from-the-first",
            "All three shifts start from the state as it came; each has to start from what the one before left.",
            partial(_state_is, mistaken=_from_one_state),
        ),
        Mistake(
            "xorshift32",
            "more-than-32-bits",
            "Your state is wider than 32 bits, so bits that should fall off on the left stay.",
            _too_wide,
        ),
        Mistake(
            "xorshift32",
            "random-of-the-old-state",
            "The random number is made of the state before the step; it should be made of the new one.",
            partial(_random_is, mistaken=lambda old, _: old / 2**32),
        ),
        Mistake(
            "xorshift32",
            "divided-by-2^31",
            "Your random numbers reach 2: an unsigned number of 32 bits has 2^32 values.",
            partial(_random_is, mistaken=lambda _, new: new / 2**31),
        ),
    ),
)
