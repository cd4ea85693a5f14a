"""Checks of motion_blur: times while the shutter is open, and rays as a moving object sees them."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np

from course.grading.checks.check import Array, Check, Failure, Mistake, ModuleChecks, Trial
from course.grading.checks.contract import (
    DTYPES,
    at,
    check_array,
    check_close,
    check_refused,
    check_untouched,
    finite_numbers,
    near,
    worst_units,
)
from course.grading.checks.statistics import FALSE_FAIL, check_uniform

MODULE = "motion_blur"

OWN_TIME = "Each ray has a time of its own; no time counts for the whole batch."


def _slack(dtype: Any, scale: float) -> float:
    """What rounding may cost a right function whose terms are no larger than scale."""
    return 8 * float(np.finfo(dtype).eps) * scale


def _shutter(rng: np.random.Generator) -> tuple[float, float]:
    """A shutter that opens neither at 0 nor a whole second before it closes."""
    first = float(rng.uniform(0.3, 2.0) * rng.choice((-1, 1)))
    return first, first + float(rng.uniform(1.2, 2.5))


def _velocity(rng: np.random.Generator) -> Array:
    """A velocity with no component near 0, none like another, and a speed that is not 1."""
    sizes = rng.permutation((0.7, 1.3, 2.1)) * rng.uniform(0.9, 1.1, 3)
    return np.asarray(sizes * rng.choice((-1.0, 1.0), 3), np.float64)


def _times(rng: np.random.Generator, n: int, dtype: Any = np.float64) -> Array:
    return rng.uniform(-2.0, 3.0, n).astype(dtype)


# ---------------------------------------------------------------- shutter_times


def _shutter_contract(trial: Trial) -> None:
    first, last = _shutter(trial.rng)
    for dtype in DTYPES:
        u = np.concatenate((worst_units(1, dtype)[0], trial.rng.random(20, dtype)))
        for start, end in ((first, last), (-1e6, 1e6 + 0.2), (0.0, 1e-30)):
            # Numbers of NumPy's own, which must not change the dtype.
            times = trial.call(np.float64(start), np.float64(end), u)
            check_array(times, u.shape, dtype, f"the times of {u.dtype} u")
        check_array(trial.call(first, last, u[:0]), (0,), dtype, "the times of no rays")


def _shutter_untouched(trial: Trial) -> None:
    first, last = _shutter(trial.rng)
    check_untouched(trial, first, last, trial.rng.random(10, np.float32))


def _shutter_refuses(trial: Trial) -> None:
    first, last = _shutter(trial.rng)
    u = trial.rng.random(5, np.float32)
    check_refused(trial, first, last, u.reshape(1, 5), named="shape of u")
    check_refused(trial, last, first, u, named="order of open and close")
    check_refused(trial, first, float("inf"), u, named="close, which is not finite")
    check_refused(trial, float("nan"), last, u, named="open, which is no number")


def _inside(trial: Trial) -> None:
    for dtype in DTYPES:
        first, last = _shutter(trial.rng)
        u = np.concatenate((worst_units(1, dtype)[0], trial.rng.random(2000, dtype)))
        times = finite_numbers(trial.call(first, last, u), u.shape)
        slack = _slack(dtype, abs(first) + abs(last))
        outside = np.maximum(first - times, times - last)
        worst = int(np.argmax(outside))
        if outside[worst] > slack:
            raise Failure(
                f"times in [{first:.6g}, {last:.6g})",
                f"{times[worst]:.6g}",
                at(u=u)(worst),
                "No ray may see the scene before the shutter opens or after it closes.",
            )


def _rising(trial: Trial) -> None:
    first, last = _shutter(trial.rng)
    u = np.sort(trial.rng.random(2000, np.float32))
    times = finite_numbers(trial.call(first, last, u), u.shape)
    steps = np.diff(times)
    worst = int(np.argmin(steps))
    if steps[worst] < -_slack(np.float32, abs(first) + abs(last)):
        raise Failure(
            "times that rise with u",
            f"{times[worst + 1]:.6g} s after {times[worst]:.6g} s",
            f"{at(u=u)(worst)}, then {at(u=u)(worst + 1)}; the shutter is open from {first:.6g} to {last:.6g}",
            "A larger u stands for a later moment.",
        )
    check_close(
        times[-1:] - times[:1],
        (last - first) * (u[-1:].astype(float) - u[:1]),
        _slack(np.float32, abs(first) + abs(last)),
        "the time between the first ray and the last",
        hint="All the time that the shutter is open is to be used.",
    )


def _instant(trial: Trial) -> None:
    for dtype in DTYPES:
        u = np.concatenate((worst_units(1, dtype)[0], trial.rng.random(50, dtype)))
        for moment in (0.0, float(trial.rng.uniform(-9, 9)), 0.1):
            check_close(
                finite_numbers(trial.call(moment, moment, u), u.shape),
                np.full(u.shape, moment, dtype),
                0.0 if moment == 0 else _slack(dtype, abs(moment)),
                "the time of a shutter that closes as it opens",
                at(u=u),
                "With open = close every ray sees that one moment.",
            )


def _even(trial: Trial) -> None:
    for dtype in DTYPES:
        first, last = _shutter(trial.rng)
        u = (np.arange(256) / 256).astype(dtype)
        times = finite_numbers(trial.call(first, last, u), u.shape)
        slack = _slack(dtype, abs(first) + abs(last))
        check_close(
            times[:1],
            np.array([first]),
            slack,
            "the time of u = 0",
            hint="The first moment is the one when the shutter opens.",
        )
        check_close(
            np.diff(times),
            np.full(255, (last - first) / 256),
            2 * slack,
            "the step of time that 1/256 of u makes",
            at(u=u[:-1]),
            "Equal steps of u are equal steps of time, so that no moment counts more than another.",
        )


def _uniform(trial: Trial) -> None:
    first, last = _shutter(trial.rng)
    u = trial.rng.random(5000, np.float32)
    times = finite_numbers(trial.call(first, last, u), u.shape)
    share = (times - first) / (last - first)
    trial.show("histogram", "Times, as a share of the exposure", yours=share)
    off = np.maximum(-share, share - 1)
    if off.max() > 1e-5:
        raise Failure(
            f"times in [{first:.6g}, {last:.6g})",
            f"{times[off.argmax()]:.6g}",
            at(u=u)(int(off.argmax())),
            "Before it is asked whether times are even, they have to be while the shutter is open.",
        )
    check_uniform(
        share[None], (50,), "times", "All moments between open and close are equally probable."
    )


# ---------------------------------------------------------------- displacement


def _displacement_contract(trial: Trial) -> None:
    velocity = _velocity(trial.rng)
    for dtype in DTYPES:
        ends = np.array([0, -1e6, 1e6, 1e-30], dtype)
        time = np.concatenate((worst_units(1, dtype)[0], ends, _times(trial.rng, 20, dtype)))
        # One point's dtype must not change the batch's.
        for v in (velocity, velocity.astype(np.float32), velocity * 1e6, tuple(velocity.tolist())):
            what = f"the displacement for {time.dtype} times"
            check_array(trial.call(v, time), (3, len(time)), dtype, what)
        check_array(trial.call(velocity, time[:0]), (3, 0), dtype, "the displacement of no rays")


def _displacement_untouched(trial: Trial) -> None:
    check_untouched(trial, _velocity(trial.rng), _times(trial.rng, 10, np.float32))


def _displacement_refuses(trial: Trial) -> None:
    velocity, time = _velocity(trial.rng), _times(trial.rng, 5, np.float32)
    check_refused(trial, velocity[:2], time, named="shape of velocity")
    check_refused(trial, velocity[:, None], time, named="shape of velocity")
    check_refused(trial, velocity, time[None], named="shape of time")


def _one_second(trial: Trial) -> None:
    velocity = _velocity(trial.rng)
    for dtype in DTYPES:
        time = np.array([1, 0, -1], dtype)
        gone = finite_numbers(trial.call(velocity, time), (3, 3))
        check_close(
            gone,
            np.stack((velocity, 0 * velocity, -velocity), axis=1),
            _slack(dtype, 2.5),
            "the way that was gone",
            at(time=time),
            "Velocity is the way gone in one second; at time 0 nothing has moved.",
        )


def _linear(trial: Trial) -> None:
    velocity = _velocity(trial.rng)
    for dtype in DTYPES:
        # Multiples of 1/64, so that their sums are exact.
        a, b = (np.rint(64 * _times(trial.rng, 500)).astype(dtype) / dtype(64) for _ in range(2))
        gone = finite_numbers(trial.call(velocity, np.concatenate((a, b, a + b))), (3, 1500))
        check_close(
            gone[:, 1000:],
            gone[:, :500] + gone[:, 500:1000],
            _slack(dtype, 15.0),
            "the way gone in time a + b",
            at(a=a, b=b),
            "At a constant velocity twice the time is twice the way.",
        )


def _displacement_each(trial: Trial) -> None:
    velocity, time = _velocity(trial.rng), _times(trial.rng, 300)
    order = trial.rng.permutation(300)
    gone = finite_numbers(trial.call(velocity, time), (3, 300))
    again = finite_numbers(trial.call(velocity, time[order]), (3, 300))
    check_close(
        again,
        gone[:, order],
        _slack(np.float64, 10.0),
        "the same way for the same time, wherever it stands in the batch:",
        at(time=time[order]),
        OWN_TIME,
    )
    spread = gone.max(axis=1) - gone.min(axis=1)
    check_close(
        spread,
        np.abs(velocity) * np.ptp(time),
        _slack(np.float64, 50.0),
        "the way between the earliest ray and the latest, along x, y and z,",
        hint=OWN_TIME,
    )


# ---------------------------------------------------------------- to_object_space


def _origins(rng: np.random.Generator, n: int, dtype: Any = np.float64) -> Array:
    return rng.uniform(-3.0, 3.0, (3, n)).astype(dtype)


def _space_contract(trial: Trial) -> None:
    velocity, rng = _velocity(trial.rng), trial.rng
    for o_dtype in DTYPES:
        for t_dtype in DTYPES:
            origins, time = _origins(rng, 30, o_dtype), _times(rng, 30, t_dtype)
            origins[:, 0], origins[:, 1], time[:2] = 1e6, 0, (1e6, 0)
            dtype = np.result_type(o_dtype, t_dtype)
            what = f"the result for {origins.dtype} origins and {time.dtype} times"
            for v in (velocity, velocity.astype(np.float32), tuple(velocity.tolist())):
                check_array(trial.call(origins, v, time), (3, 30), dtype, what)
            none = trial.call(origins[:, :0], velocity, time[:0])
            check_array(none, (3, 0), dtype, "the result for no rays")


def _space_untouched(trial: Trial) -> None:
    rng = trial.rng
    check_untouched(
        trial, _origins(rng, 10, np.float32), _velocity(rng), _times(rng, 10, np.float32)
    )


def _space_refuses(trial: Trial) -> None:
    rng = trial.rng
    origins, velocity, time = _origins(rng, 5), _velocity(rng), _times(rng, 5)
    check_refused(trial, origins[:2], velocity, time, named="shape of origins")
    check_refused(trial, origins[:, 0], velocity, time, named="shape of origins")
    check_refused(trial, origins, velocity[:2], time, named="shape of velocity")
    check_refused(trial, origins, velocity, time[:4], named="number of times")


def _at_rest(trial: Trial) -> None:
    for dtype in DTYPES:
        origins, time = _origins(trial.rng, 200, dtype), 1000 * _times(trial.rng, 200, dtype)
        origins[:, :3] = np.array([[0, 1e-30, 1], [1e30, -1e30, 2], [-0.0, 3, -3]], dtype)
        seen = finite_numbers(trial.call(origins, np.zeros(3), time), (3, 200))
        check_close(
            seen,
            origins,
            0.0,
            "bit for bit the origin that was given:",
            at(origin=origins, time=time),
            "An object that stands still sees every ray where it is, at any time.",
        )


def _at_start(trial: Trial) -> None:
    velocity = _velocity(trial.rng)
    for dtype in DTYPES:
        origins = _origins(trial.rng, 200, dtype)
        seen = finite_numbers(trial.call(origins, velocity, np.zeros(200, dtype)), (3, 200))
        check_close(
            seen,
            origins,
            _slack(dtype, 3.0),
            "the origin that was given:",
            at(origin=origins),
            "At time 0 the object is where the scene has put it.",
        )


def _travels_along(trial: Trial) -> None:
    """A ray that starts at a place on the object starts there at every time."""
    velocity = _velocity(trial.rng)
    for dtype in DTYPES:
        place, time = _origins(trial.rng, 1), _times(trial.rng, 500, dtype)
        way = velocity.reshape(3, 1) * time.astype(float)
        origins = (place + way).astype(dtype)
        seen = finite_numbers(trial.call(origins, velocity, time), (3, 500))
        check_close(
            seen,
            np.broadcast_to(place, (3, 500)),
            _slack(dtype, 15.0),
            "a ray that starts on the object, seen from the object, at",
            at(origin=origins, time=time),
            "Whoever travels along with the object stays at the same place of it; its velocity is"
            f" ({velocity[0]:.6g}, {velocity[1]:.6g}, {velocity[2]:.6g}) here.",
        )


def _space_each(trial: Trial) -> None:
    rng = trial.rng
    origins, velocity, time = _origins(rng, 300), _velocity(rng), _times(rng, 300)
    order = rng.permutation(300)
    seen = finite_numbers(trial.call(origins, velocity, time), (3, 300))
    again = finite_numbers(trial.call(origins[:, order], velocity, time[order]), (3, 300))
    check_close(
        again,
        seen[:, order],
        _slack(np.float64, 15.0),
        "the same result for the same ray, wherever it stands in the batch:",
        at(origin=origins[:, order], time=time[order]),
        OWN_TIME,
    )
    shift = seen - origins
    check_close(
        shift.max(axis=1) - shift.min(axis=1),
        np.abs(velocity) * np.ptp(time),
        _slack(np.float64, 60.0),
        "the way between the earliest ray's shift and the latest's, along x, y and z,",
        hint=OWN_TIME,
    )


# ---------------------------------------------------------------- mistakes


_near = partial(near, tolerance=1e-9)


def _some_times(trial: Trial) -> tuple[Array, Array, float, float]:
    """The student's times, and what they should have been made of."""
    first, last = _shutter(trial.rng)
    u = trial.rng.random(100)
    times = finite_numbers(trial.call(first, last, u.copy()), u.shape)
    return times, u, first, last


def _same_time_for_all(trial: Trial) -> bool:
    times, _, first, last = _some_times(trial)
    return bool(np.ptp(times) == 0 and first <= times[0] <= last)


def _unit_time(trial: Trial) -> bool:
    times, u, _, _ = _some_times(trial)
    return _near(times, u)


def _open_ignored(trial: Trial) -> bool:
    times, u, first, last = _some_times(trial)
    return _near(times, last * u) or _near(times, (last - first) * u)


def _close_as_length(trial: Trial) -> bool:
    times, u, first, last = _some_times(trial)
    return _near(times - first, last * u)


def _backwards(trial: Trial) -> bool:
    times, u, first, last = _some_times(trial)
    return _near(last - times, (last - first) * u)


def _u_unused(trial: Trial) -> bool:
    times, _, first, last = _some_times(trial)
    again = finite_numbers(trial.call(first, last, trial.rng.random(100)), (100,))
    return bool(np.ptp(times) > 0 and _near(again, times))


def _uneven(trial: Trial) -> bool:
    first, last = _shutter(trial.rng)
    u = np.linspace(0, 1, 101)[:-1]
    share = (finite_numbers(trial.call(first, last, u.copy()), u.shape) - first) / (last - first)
    # From open almost to close and never back, yet not at an even pace.
    return bool(
        abs(share[0]) < 1e-9
        and 0.9 < share[-1] <= 1
        and (np.diff(share) >= 0).all()
        and np.abs(share - u).max() > 0.02
        # Nor in a few steps.
        and len(np.unique(share)) > 50
    )


def _gone(trial: Trial) -> tuple[Array, Array, Array]:
    velocity, time = _velocity(trial.rng), _times(trial.rng, 50)
    return finite_numbers(trial.call(velocity.copy(), time.copy()), (3, 50)), velocity, time


def _gone_backwards(trial: Trial) -> bool:
    gone, velocity, time = _gone(trial)
    return _near(gone + np.outer(velocity, time), np.zeros((3, 50)))


def _gone_by_speed(trial: Trial) -> bool:
    gone, velocity, time = _gone(trial)
    speed = np.linalg.norm(velocity)
    alike = np.broadcast_to(speed * time, (3, 50))
    return _near(gone, alike) or _near(gone, np.outer(np.abs(velocity), time))


def _gone_at_unit_speed(trial: Trial) -> bool:
    gone, velocity, time = _gone(trial)
    return _near(gone, np.outer(velocity / np.linalg.norm(velocity), time))


def _gone_at_first_time(trial: Trial) -> bool:
    gone, velocity, time = _gone(trial)
    return _near(gone, np.outer(velocity, np.full(50, time[0])))


def _gone_at_mean_time(trial: Trial) -> bool:
    gone, velocity, time = _gone(trial)
    return _near(gone, np.outer(velocity, np.full(50, time.mean())))


def _gone_at_once(trial: Trial) -> bool:
    gone, velocity, _ = _gone(trial)
    return _near(gone, np.outer(velocity, np.ones(50)))


def _gone_faster(trial: Trial) -> bool:
    gone, velocity, time = _gone(trial)
    return any(_near(gone, f * np.outer(velocity, time**2)) for f in (0.5, 1.0))


def _way_wrong(trial: Trial) -> bool:
    """Whether the student's displacement is to blame for where the origins go."""
    velocity, time = _velocity(trial.rng), _times(trial.rng, 50)
    gone = finite_numbers(trial.call_other("displacement", velocity.copy(), time.copy()), (3, 50))
    return not _near(gone, np.outer(velocity, time))


def _shift(trial: Trial) -> tuple[Array, Array, Array, Array]:
    """How far the student's function has moved each ray's origin."""
    rng = trial.rng
    origins, velocity, time = _origins(rng, 50), _velocity(rng), _times(rng, 50)
    seen = finite_numbers(trial.call(origins.copy(), velocity.copy(), time.copy()), (3, 50))
    return seen - origins, origins, velocity, time


def _moved_along(trial: Trial) -> bool:
    shift, _, velocity, time = _shift(trial)
    return _near(shift, np.outer(velocity, time))


def _moved_at_first_time(trial: Trial) -> bool:
    shift, _, velocity, time = _shift(trial)
    return _near(shift, np.outer(velocity, np.full(50, -time[0])))


def _moved_at_once(trial: Trial) -> bool:
    shift, _, velocity, _ = _shift(trial)
    return _near(shift, np.outer(velocity, np.full(50, -1.0)))


def _not_moved(trial: Trial) -> bool:
    return _near(_shift(trial)[0], np.zeros((3, 50)))


def _only_moved(trial: Trial) -> bool:
    shift, origins, velocity, time = _shift(trial)
    seen = shift + origins
    return any(_near(seen, sign * np.outer(velocity, time)) for sign in (-1, 1))


def _moved_from_object(trial: Trial) -> bool:
    shift, origins, velocity, time = _shift(trial)
    return _near(shift + 2 * origins, np.outer(velocity, time))


CHECKS = ModuleChecks(
    MODULE,
    checks=(
        Check(
            "shutter_times",
            "contract",
            "Times have the shape and the dtype of u, for no rays too",
            _shutter_contract,
            "contract",
        ),
        Check(
            "shutter_times",
            "untouched",
            "u is only read, and NumPy's global random numbers are left alone",
            _shutter_untouched,
            "contract",
            0.5,
        ),
        Check(
            "shutter_times",
            "refuses",
            "A wrong shape and a shutter that closes before it opens are refused",
            _shutter_refuses,
            "contract",
            0.5,
        ),
        Check("shutter_times", "inside", "Every time lies between open and close", _inside),
        Check("shutter_times", "rising", "Times rise with u", _rising),
        Check(
            "shutter_times",
            "instant",
            "A shutter that closes as it opens gives that moment",
            _instant,
        ),
        Check("shutter_times", "even", "Equal steps of u are equal steps of time", _even),
        Check(
            "shutter_times",
            "uniform",
            "All moments of the exposure are equally probable",
            _uniform,
            "distribution",
            2.0,
            FALSE_FAIL,
        ),
        Check(
            "displacement",
            "contract",
            "Displacements are (3, N) and of the dtype of time, for no rays too",
            _displacement_contract,
            "contract",
        ),
        Check(
            "displacement",
            "untouched",
            "velocity and time are only read",
            _displacement_untouched,
            "contract",
            0.5,
        ),
        Check(
            "displacement",
            "refuses",
            "Wrong shapes are refused",
            _displacement_refuses,
            "contract",
            0.5,
        ),
        Check(
            "displacement",
            "one-second",
            "In one second an object goes its velocity, at time 0 nowhere",
            _one_second,
        ),
        Check("displacement", "linear", "The way gone is proportional to the time", _linear),
        Check(
            "displacement", "own-time", "Each ray gets the way of its own time", _displacement_each
        ),
        Check(
            "to_object_space",
            "contract",
            "Origins are (3, N) and of the promoted dtype, for no rays too",
            _space_contract,
            "contract",
        ),
        Check(
            "to_object_space",
            "untouched",
            "origins, velocity and time are only read",
            _space_untouched,
            "contract",
            0.5,
        ),
        Check(
            "to_object_space",
            "refuses",
            "Wrong shapes are refused",
            _space_refuses,
            "contract",
            0.5,
        ),
        Check(
            "to_object_space",
            "at-rest",
            "An object that stands still sees the rays bit for bit where they are",
            _at_rest,
        ),
        Check(
            "to_object_space",
            "at-start",
            "At time 0 a moving object sees the rays where they are",
            _at_start,
        ),
        Check(
            "to_object_space",
            "travels-along",
            "What travels along with the object stays at one place of it",
            _travels_along,
            points=2.0,
        ),
        Check(
            "to_object_space",
            "own-time",
            "Each ray is moved by the way of its own time",
            _space_each,
        ),
    ),
    mistakes=(
        Mistake(
            "shutter_times",
            "one-time",
            "All rays got one and the same moment, so a moving object is sharp, only somewhere else;"
            " every ray needs a moment of its own.",
            _same_time_for_all,
        ),
        Mistake(
            "shutter_times",
            "unit-time",
            "Your times run from 0 to 1 whatever the shutter does; u still has to be stretched and shifted"
            " to the exposure.",
            _unit_time,
        ),
        Mistake(
            "shutter_times",
            "open-ignored",
            "Your exposure starts at time 0; the shutter opens at `open`, which may be any time.",
            _open_ignored,
        ),
        Mistake(
            "shutter_times",
            "close-as-length",
            "You take `close` for the length of the exposure, but it is the time at which it ends.",
            _close_as_length,
        ),
        Mistake(
            "shutter_times",
            "backwards",
            "Your times run from close back to open; they should rise with u.",
            _backwards,
        ),
        Mistake(
            "shutter_times",
            "u-unused",
            "Your times are a row that doesn't depend on u, so that every batch shows the same few ghosts.",
            _u_unused,
        ),
        Mistake(
            "shutter_times",
            "uneven",
            "Your times fill the exposure, but some moments come more often than others, so the streak has"
            " a bright end.",
            _uneven,
        ),
        Mistake(
            "displacement",
            "against-velocity",
            "Your object moves against its velocity; a sign is the wrong way round.",
            _gone_backwards,
        ),
        Mistake(
            "displacement",
            "speed-only",
            "You use only how large the velocity is, and lose in which direction it points along each axis.",
            _gone_by_speed,
        ),
        Mistake(
            "displacement",
            "unit-speed",
            "Your object always moves at 1 m/s; the velocity's length is its speed and must stay.",
            _gone_at_unit_speed,
        ),
        Mistake(
            "displacement",
            "gone-at-first-time",
            "You use the first ray's time for all rays; each has its own.",
            _gone_at_first_time,
        ),
        Mistake(
            "displacement",
            "gone-at-mean-time",
            "You use the mean time for all rays, which moves the object but leaves no streak; each ray has"
            " a time of its own.",
            _gone_at_mean_time,
        ),
        Mistake(
            "displacement",
            "gone-at-once",
            "Your object has gone the way of one second at every time.",
            _gone_at_once,
        ),
        Mistake(
            "displacement",
            "accelerated",
            "Your object gets faster with the square of the time; here the velocity is constant.",
            _gone_faster,
        ),
        Mistake(
            "to_object_space",
            "displacement-wrong",
            "Your displacement isn't right yet, and this function most likely builds on it; mend that one first.",
            _way_wrong,
        ),
        Mistake(
            "to_object_space",
            "wrong-way",
            "You move the rays along with the object; seen from an object that moves to the right, the rest"
            " of the world moves to the left.",
            _moved_along,
        ),
        Mistake(
            "to_object_space",
            "seen-at-first-time",
            "You use the first ray's time for all rays; each has its own.",
            _moved_at_first_time,
        ),
        Mistake(
            "to_object_space",
            "seen-at-once",
            "You move every ray by the way of one whole second, whatever its time is.",
            _moved_at_once,
        ),
        Mistake(
            "to_object_space",
            "not-moved",
            "You hand the origins back as they came, so the object never moves.",
            _not_moved,
        ),
        Mistake(
            "to_object_space",
            "origins-lost",
            "You hand back how far the object has gone, but the ray's own origin is missing.",
            _only_moved,
        ),
        Mistake(
            "to_object_space",
            "other-difference",
            "Your difference is the wrong way round: it is the object as the ray sees it, not the ray as the"
            " object sees it.",
            _moved_from_object,
        ),
    ),
)
