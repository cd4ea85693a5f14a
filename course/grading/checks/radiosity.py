"""Checks of radiosity: the cells of a hemicube, one iteration of gathering, one shot, and which patches to divide.

Scenes are tables of form factors made here, for areas of any size: what A_i F[i, j] and A_j F[j, i] have in common is
the light that two patches exchange. So rows and columns differ, and whoever mixes them up is found out.
"""

from __future__ import annotations

import math
from collections.abc import Callable
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
    contract_checks,
    finite_floats,
    near,
    pair,
)

EXACT = 1e-9
"""Of numbers around 1, in double precision."""

SINGLE = 1e-5
"""The same in single precision."""

SIZES = (2, 4, 8, 30, 64)
"""Of hemicubes."""

SQUARE_ABOVE = 4 / math.pi / math.sqrt(2) * math.atan(1 / math.sqrt(2))
"""Form factor of a hemicube's whole top, 0.5541: of a square of side 2 at distance 1, seen from below its centre."""


# ---------------------------------------------------------------- hemicube_form_factors


def _steps(k: int) -> Array:
    return np.linspace(-1, 1, k + 1)


def _centres(k: int) -> tuple[Array, Array]:
    """Delta form factors from what holds at the cells' centres, times their area."""
    edges = _steps(k)
    x = (edges[1:] + edges[:-1]) / 2
    z = x[k // 2 :][:, None]
    area = 4 / k / k
    top = area / math.pi / (1 + x**2 + x[:, None] ** 2) ** 2
    return top, area / math.pi * z / (1 + x**2 + z**2) ** 2


def _integrals(k: int) -> tuple[Array, Array]:
    """The same, integrated over the cells: differences of the closed forms at their corners."""
    edges = _steps(k)
    y, x = edges[:, None], edges
    a, b = np.sqrt(1 + x**2), np.sqrt(1 + y**2)
    above = (x / a * np.arctan(y / a) + y / b * np.arctan(x / b)) / (2 * math.pi)
    z = edges[k // 2 :][:, None]
    c = np.sqrt(1 + z**2)
    beside = (np.arctan(x) - np.arctan(x / c) / c) / (2 * math.pi)
    top, side = (np.diff(np.diff(table, axis=0), axis=1) for table in (above, beside))
    return top, side


def _hemicube(trial: Trial, k: int) -> tuple[Array, Array]:
    top, side = pair(trial.call(k), "top", "side")
    return finite_floats(top, (k, k), "top"), finite_floats(side, (k // 2, k), "side")


def _hemicube_contract(trial: Trial) -> None:
    for k in SIZES:
        for name, shape, array in zip(
            ("top", "side"),
            ((k, k), (k // 2, k)),
            pair(trial.call(k), "top", "side"),
            strict=True,
        ):
            check_array(array, shape, np.float32, f"{name} of k = {k}")


def _hemicube_untouched(trial: Trial) -> None:
    check_untouched(trial, 8)


def _hemicube_refuses(trial: Trial) -> None:
    for k in (0, 1, 3, 33, -2):
        check_refused(trial, k, named=f"k = {k}")


def _check_part(part: int, name: str, trial: Trial) -> None:
    for k in SIZES:
        found = _hemicube(trial, k)[part]
        centre, integral = _centres(k)[part], _integrals(k)[part]
        # Either is right, and so is what lies between: a finer grid inside each cell.
        low, high = np.minimum(centre, integral), np.maximum(centre, integral)
        slack = SINGLE * high
        nearest = np.clip(found, low - slack, high + slack)
        wrong = np.unravel_index(int(np.abs(found - nearest).argmax()), found.shape)
        if found[wrong] != nearest[wrong]:
            row, column = (int(i) for i in wrong)
            raise Failure(
                f"{name}[{row}, {column}] of k = {k}: {centre[wrong]:.6g}",
                f"{found[wrong]:.6g}",
                f"{found[wrong] / centre[wrong]:.4g} times as much",
                "cos cos' / (pi r^2), times the cell's area.",
            )


def _hemicube_sum(trial: Trial) -> None:
    for k in SIZES:
        top, side = _hemicube(trial, k)
        total = float(top.sum() + 4 * side.sum())
        bound = 1 / k**2
        if not abs(total - 1) <= bound:
            raise Failure(
                f"sum(top) + 4 sum(side) to be 1 within {bound:.2g} for k = {k}",
                f"{total:.6g}",
                hint="All light leaves through some cell.",
            )


def _hemicube_share(trial: Trial) -> None:
    k = 64
    share = float(_hemicube(trial, k)[0].sum())
    if not abs(share - SQUARE_ABOVE) <= 1 / k**2:
        raise Failure(
            f"{SQUARE_ABOVE:.4f} of the light to leave through the top",
            f"{share:.4f}",
            f"k = {k}",
            "The top is 2 x 2, and 1 above the patch.",
        )


# ---------------------------------------------------------------- rooms


def _room(rng: np.random.Generator, patches: int, dtype: Any = np.float64) -> dict[str, Array]:
    """Patches of all sizes in a closed room without light from outside: rows of form factors sum to at most 1."""
    areas = 10.0 ** rng.uniform(-1, 1, patches)
    exchanged = rng.random((patches, patches)) ** 3
    exchanged = np.triu(exchanged, 1) + np.triu(exchanged, 1).T
    factors = exchanged / areas[:, None]
    factors /= factors.sum(axis=1).max(initial=1e-300) * 1.01
    return {
        "radiosity": rng.uniform(0, 4, (3, patches)).astype(dtype),
        "unshot": rng.uniform(0, 2, (3, patches)).astype(dtype),
        "emission": rng.uniform(0, 1, (3, patches)).astype(dtype),
        "reflectance": rng.uniform(0.1, 0.9, (3, patches)).astype(dtype),
        "areas": areas.astype(dtype),
        "factors": factors.astype(dtype),
    }


def _limit(room: dict[str, Array]) -> Array:
    """(3, P) radiosities that solve (I - rho F) B = E."""
    return np.stack(
        [
            np.linalg.solve(np.eye(len(rho)) - rho[:, None] * room["factors"], emission)
            for rho, emission in zip(room["reflectance"], room["emission"], strict=True)
        ]
    )


def _patch(room: dict[str, Array]) -> Callable[[int], str]:
    return at(emission=room["emission"], reflectance=room["reflectance"])


# ---------------------------------------------------------------- gather


GATHER = ("radiosity", "emission", "reflectance", "factors")


def _gather_of(room: dict[str, Array]) -> list[Array]:
    return [room[name].copy() for name in GATHER]


def _gather(trial: Trial, room: dict[str, Array]) -> Array:
    return finite_floats(trial.call(*_gather_of(room)), room["radiosity"].shape)


def _gather_contract(trial: Trial) -> None:
    for patches in (20, 1, 0):
        for dtype in DTYPES:
            value = trial.call(*_gather_of(_room(trial.rng, patches, dtype)))
            check_array(value, (3, patches), dtype)
    given = _gather_of(_room(trial.rng, 6, np.float32))
    for number in range(4):
        mixed = [x.astype(np.float64) if i == number else x for i, x in enumerate(given)]
        check_array(trial.call(*mixed), (3, 6), np.float64, "the result of mixed dtypes")


def _gather_untouched(trial: Trial) -> None:
    check_untouched(trial, *_gather_of(_room(trial.rng, 12)))


def _gather_refuses(trial: Trial) -> None:
    given = _gather_of(_room(trial.rng, 5))
    names = ("radiosity", "emission", "reflectance", "form_factors")
    for number, name in enumerate(names):
        for bad in (given[number][:2], given[number][:, :4], given[number][0]):
            wrong = [bad if i == number else x for i, x in enumerate(given)]
            check_refused(trial, *wrong, named=name)


def _gather_values(trial: Trial) -> None:
    for dtype, tolerance in ((np.float64, EXACT), (np.float32, 10 * SINGLE)):
        room = _room(trial.rng, 60, dtype)
        arriving = np.einsum(
            "ij,cj->ci", *(room[n].astype(float) for n in ("factors", "radiosity"))
        )
        check_close(
            _gather(trial, room),
            room["emission"] + room["reflectance"] * arriving,
            tolerance,
            "the radiosity",
            _patch(room),
            "What a patch emits, and its own reflectance times all that reaches it.",
        )


def _gather_dark(trial: Trial) -> None:
    room = _room(trial.rng, 40)
    room["radiosity"][:] = 0
    check_close(
        _gather(trial, room),
        room["emission"],
        0.0,
        "in a dark room the emission alone:",
        _patch(room),
        "Lamps shine whether light reaches them or not.",
    )


def _gather_fixed(trial: Trial) -> None:
    room = _room(trial.rng, 40)
    room["radiosity"] = _limit(room)
    check_close(
        _gather(trial, room),
        room["radiosity"],
        EXACT * 10,
        "the solution of (I - rho F) B = E, left as it is:",
        _patch(room),
        "At the limit an iteration changes nothing.",
    )


def _gather_converges(trial: Trial) -> None:
    room = _room(trial.rng, 30)
    limit = _limit(room)
    room["radiosity"] = np.zeros_like(limit)
    for _ in range(60):
        room["radiosity"] = _gather(trial, room)
    check_close(
        room["radiosity"],
        limit,
        0.02,
        "the radiosity after 60 iterations from darkness",
        _patch(room),
        "Each iteration adds one more reflection.",
    )


# ---------------------------------------------------------------- shoot


SHOOT = ("radiosity", "unshot", "reflectance", "areas")


def _shoot_of(room: dict[str, Array], shooter: int) -> list[Any]:
    return [*(room[name].copy() for name in SHOOT), room["factors"][shooter].copy(), shooter]


def _shoot(trial: Trial, room: dict[str, Array], shooter: int) -> tuple[Array, Array]:
    shape = room["radiosity"].shape
    after, left = pair(trial.call(*_shoot_of(room, shooter)), "radiosity", "unshot")
    return finite_floats(after, shape, "radiosity"), finite_floats(left, shape, "unshot")


def _received(room: dict[str, Array], shooter: int) -> Array:
    light = room["unshot"][:, shooter].astype(float) * float(room["areas"][shooter])
    share = room["factors"][shooter].astype(float) / room["areas"]
    return np.asarray(room["reflectance"] * light[:, None] * share)


def _shoot_contract(trial: Trial) -> None:
    for patches in (20, 1):
        for dtype in DTYPES:
            room = _room(trial.rng, patches, dtype)
            value = pair(trial.call(*_shoot_of(room, patches - 1)), "radiosity", "unshot")
            for name, array in zip(("radiosity", "unshot"), value, strict=True):
                check_array(array, (3, patches), dtype, name)
    given = _shoot_of(_room(trial.rng, 6, np.float32), 2)
    for number in range(5):
        mixed = [x.astype(np.float64) if i == number else x for i, x in enumerate(given)]
        for array in pair(trial.call(*mixed), "radiosity", "unshot"):
            check_array(array, (3, 6), np.float64, "a result of mixed dtypes")


def _shoot_untouched(trial: Trial) -> None:
    check_untouched(trial, *_shoot_of(_room(trial.rng, 12), 4))


def _shoot_refuses(trial: Trial) -> None:
    given = _shoot_of(_room(trial.rng, 5), 0)
    names = ("radiosity", "unshot", "reflectance", "areas", "form_factors")
    for number, name in enumerate(names):
        for bad in (given[number][..., :4], given[number][None]):
            wrong = [bad if i == number else x for i, x in enumerate(given)]
            check_refused(trial, *wrong, named=name)
    for shooter in (-1, 5):
        check_refused(trial, *given[:5], shooter, named=f"shooter {shooter}")


def _shoot_received(trial: Trial) -> None:
    for dtype, tolerance in ((np.float64, EXACT), (np.float32, 20 * SINGLE)):
        room = _room(trial.rng, 50, dtype)
        shooter = int(trial.rng.integers(50))
        after, _ = _shoot(trial, room, shooter)
        check_close(
            after,
            room["radiosity"] + _received(room, shooter),
            tolerance,
            "the radiosity",
            at(area=room["areas"], reflectance=room["reflectance"]),
            "Light is radiosity times area; what arrives is spread over the receiver's area, and reflected there.",
        )


def _shoot_unshot(trial: Trial) -> None:
    room = _room(trial.rng, 50)
    shooter = int(trial.rng.integers(50))
    _, left = _shoot(trial, room, shooter)
    expected = room["unshot"] + _received(room, shooter)
    others = np.arange(50) != shooter
    check_close(
        left[:, others],
        expected[:, others],
        EXACT,
        "the unshot radiosity of a receiver",
        at(area=room["areas"][others], reflectance=room["reflectance"][:, others]),
        "What is received and reflected has to be shot, too.",
    )


def _shoot_cleared(trial: Trial) -> None:
    room = _room(trial.rng, 30)
    for shooter in (0, 7, 29):
        _, left = _shoot(trial, room, shooter)
        check_close(
            left[:, shooter],
            np.zeros(3),
            0.0,
            "the shooter's unshot radiosity afterwards:",
            hint="What has been shot is gone, and a flat patch sends nothing to itself.",
        )
    # A hollow patch sees itself.
    room["factors"][7, 7] = 0.25
    _, left = _shoot(trial, room, 7)
    check_close(
        left[:, 7],
        0.25 * room["reflectance"][:, 7] * room["unshot"][:, 7],
        EXACT,
        "the unshot radiosity of a shooter that sends a fourth of its light to itself:",
        hint="What comes back to the shooter is new light.",
    )


def _shoot_energy(trial: Trial) -> None:
    room = _room(trial.rng, 40)
    room["factors"] /= room["factors"].sum(axis=1, keepdims=True)
    room["reflectance"][:] = 1
    for shooter in (0, 20):
        before = room["unshot"] @ room["areas"]
        _, left = _shoot(trial, room, shooter)
        check_close(
            left @ room["areas"] / before,
            np.ones(3),
            EXACT,
            "where nothing is absorbed, the unshot power after a shot over that before:",
            hint="Power is radiosity times area.",
        )


def _shoot_converges(trial: Trial) -> None:
    room = _room(trial.rng, 12)
    limit = _limit(room)
    room["radiosity"] = room["emission"].copy()
    room["unshot"] = room["emission"].copy()
    for _ in range(300):
        shooter = int((room["unshot"].sum(axis=0) * room["areas"]).argmax())
        room["radiosity"], room["unshot"] = _shoot(trial, room, shooter)
    check_close(
        room["radiosity"],
        limit,
        0.01,
        "the radiosity after 300 shots of the brightest",
        _patch(room),
        "Shooting ends where gathering does.",
    )


# ---------------------------------------------------------------- needs_split


STEP = 2.0**-8


def _contrast(values: Array) -> Array:
    """Difference as a share of the largest value; colours are multiples of STEP, and quotients nearly exact."""
    v = values.astype(np.float64)
    difference = (v.max(axis=1) - v.min(axis=1)).max(axis=0)
    peak = v.max(axis=(0, 1))
    return np.asarray(np.where(peak > 0, difference / np.where(peak > 0, peak, 1), 0))


def _patches(rng: np.random.Generator, points: int, n: int, dtype: Any = np.float32) -> Array:
    """Patches dark and bright, even and uneven."""
    level = 2.0 ** rng.integers(-3, 4, n)
    spread = rng.random(n)
    values = 1 - spread * rng.random((3, points, n))
    return np.asarray(np.round(values / STEP) * STEP * level, dtype)


def _check_decisions(
    trial: Trial, values: Array, threshold: float, expected: Array, hint: str
) -> None:
    value = trial.call(values.copy(), threshold)
    found = check_array(value, values.shape[2:], np.bool_, "the decisions")
    wrong = np.flatnonzero(found != expected)
    if wrong.size:
        n = int(wrong[0])
        colors = "; ".join(", ".join(f"{x:.5g}" for x in row) for row in values[:, :, n].tolist())
        raise Failure(
            f"{bool(expected[n])} where the contrast is {_contrast(values)[n]:.5g} and the threshold {threshold:.5g}",
            f"{bool(found[n])}",
            f"red, green and blue of its points: {colors}; {wrong.size} of {found.size} patches",
            hint,
        )


def _split_contract(trial: Trial) -> None:
    for dtype in DTYPES:
        for points in (1, 3, 4):
            for n in (30, 1, 0):
                values = _patches(trial.rng, points, n, dtype)
                for threshold in (0.0, 0.3, np.float64(0.3), 1.0, 1e30):
                    value = trial.call(values.copy(), threshold)
                    check_array(value, (n,), np.bool_, "the decisions")


def _split_untouched(trial: Trial) -> None:
    check_untouched(trial, _patches(trial.rng, 3, 20), 0.3)


def _split_refuses(trial: Trial) -> None:
    values = _patches(trial.rng, 4, 5)
    for bad in (values[:2], values[:, :0], values[:, 0], np.moveaxis(values, 2, 0)):
        check_refused(trial, bad, 0.3, named="patch_radiosity")
    for wrong in (-0.5, -1e-9, float("nan")):
        check_refused(trial, values, wrong, named=f"threshold {wrong}")


def _split_contrast(trial: Trial) -> None:
    for points in (2, 3, 4, 9):
        values = _patches(trial.rng, points, 1000)
        threshold = float(np.median(_contrast(values))) + STEP / 100
        _check_decisions(
            trial,
            values,
            threshold,
            _contrast(values) > threshold,
            "The largest difference in any channel, as a share of the patch's largest value.",
        )


def _split_scale(trial: Trial) -> None:
    values = _patches(trial.rng, 3, 400)
    threshold = float(np.median(_contrast(values))) + STEP / 100
    for factor in (2.0**-20, 2.0**20):
        _check_decisions(
            trial,
            values * np.float32(factor),
            threshold,
            _contrast(values) > threshold,
            "Contrast is a ratio: in dim light as in bright light the same patches are divided.",
        )


def _split_threshold(trial: Trial) -> None:
    for steps, expected in ((63, False), (64, False), (65, True)):
        values = np.ones((3, 3, 18), np.float32)
        for n in range(18):
            values[n % 3, n // 6, n] = 1 - steps * STEP
        _check_decisions(
            trial,
            values * np.float32(4),
            0.25,
            np.full(18, expected),
            "The contrast has to be over the threshold: as much is not enough.",
        )


def _split_dark(trial: Trial) -> None:
    values = _patches(trial.rng, 3, 40)
    values[:, :, ::2] = 0
    values[:, :, 1::2] = values[:, :1, 1::2]
    _check_decisions(
        trial, values, 0.0, np.zeros(40, bool), "Black patches and even ones are left alone."
    )


# ---------------------------------------------------------------- mistakes


Model = Callable[[dict[str, Array], int], tuple[Array, Array]]


def _cells_are(trial: Trial, factor: Callable[[int], tuple[Any, Any]]) -> bool:
    """The student's cells are the right ones times those factors."""
    k = 16
    found = _hemicube(trial, k)
    return all(near(a / b, f, 1e-4) for a, b, f in zip(found, _centres(k), factor(k), strict=True))


def _heights(k: int) -> Array:
    return ((np.arange(k // 2) + 0.5) * 2 / k)[:, None]


def _upside_down(trial: Trial) -> bool:
    k = 16
    return near(_hemicube(trial, k)[1] / _centres(k)[1][::-1], 1, 1e-4)


def _one_power(k: int) -> tuple[Array, Array]:
    """Right factors over those without the square."""
    top, side = _centres(k)
    area = 4 / k / k / math.pi
    return np.sqrt(area / top), np.sqrt(area * _heights(k) / side)


def _gather_is(trial: Trial, model: Callable[..., Array]) -> bool:
    room = _room(trial.rng, 30)
    return near(_gather(trial, room), model(*(room[name] for name in GATHER)), 1e-6)


def _shoot_is(trial: Trial, model: Model) -> bool:
    room = _room(trial.rng, 30)
    return all(
        near(a, b, 1e-6) for a, b in zip(_shoot(trial, room, 11), model(room, 11), strict=True)
    )


def _shot(received: Callable[[dict[str, Array], int], Array]) -> Model:
    """All right but for what is received."""

    def model(room: dict[str, Array], i: int) -> tuple[Array, Array]:
        light = received(room, i)
        left = room["unshot"].copy()
        left[:, i] = 0
        return room["radiosity"] + light, left + light

    return model


def _area_inverted(room: dict[str, Array], i: int) -> Array:
    ratio = room["areas"] / room["areas"][i]
    return np.asarray(_received(room, i) * ratio * ratio)


def _no_areas(room: dict[str, Array], i: int) -> Array:
    return np.asarray(_received(room, i) * (room["areas"] / room["areas"][i]))


def _whole_radiosity(room: dict[str, Array], i: int) -> Array:
    return _received({**room, "unshot": room["radiosity"]}, i)


def _own_reflectance(room: dict[str, Array], i: int) -> Array:
    return _received({**room, "reflectance": room["reflectance"][:, i : i + 1]}, i)


def _no_reflectance(room: dict[str, Array], i: int) -> Array:
    return _received({**room, "reflectance": np.ones_like(room["reflectance"])}, i)


def _not_cleared(room: dict[str, Array], i: int) -> tuple[Array, Array]:
    light = _received(room, i)
    return room["radiosity"] + light, room["unshot"] + light


def _not_passed_on(room: dict[str, Array], i: int) -> tuple[Array, Array]:
    left = room["unshot"].copy()
    left[:, i] = 0
    return room["radiosity"] + _received(room, i), left


def _shooter_darkened(room: dict[str, Array], i: int) -> tuple[Array, Array]:
    after, left = _shot(_received)(room, i)
    after = after.copy()
    after[:, i] -= room["unshot"][:, i]
    return after, left


def _splits(trial: Trial, model: Callable[[Array, float], Array]) -> bool:
    """The student decides as a mistake does, on patches of which it gets many wrong."""
    values = _patches(trial.rng, 4, 800).astype(np.float64)
    for threshold in (0.2371, 0.4183):
        found = np.asarray(trial.call(values.copy(), threshold))
        if found.shape != (800,) or (found != model(values, threshold)).any():
            return False
    return True


def _difference(values: Array) -> Array:
    return np.asarray((values.max(axis=1) - values.min(axis=1)).max(axis=0))


def _own_channel(values: Array, threshold: float) -> Array:
    high, low = values.max(axis=1), values.min(axis=1)
    return np.asarray(((high - low) / high > threshold).any(axis=0))


def _of_the_mean(values: Array, threshold: float) -> Array:
    return np.asarray(_difference(values) / values.mean(axis=1).max(axis=0) > threshold)


def _grey(values: Array, threshold: float) -> Array:
    grey = values.mean(axis=0)
    return np.asarray((grey.max(axis=0) - grey.min(axis=0)) / grey.max(axis=0) > threshold)


def _brightest_of_all(values: Array, threshold: float) -> Array:
    return np.asarray(_difference(values) / values.max() > threshold)


def _or_equal(trial: Trial) -> bool:
    values = np.ones((3, 3, 3), np.float32)
    for n, steps in enumerate((63, 64, 65)):
        values[0, 0, n] = 1 - steps * STEP
    return bool(np.array_equal(trial.call(values, 0.25), [False, True, True]))


# ---------------------------------------------------------------- all of them


CHECKS = ModuleChecks(
    "radiosity",
    checks=(
        *contract_checks(
            "hemicube_form_factors", _hemicube_contract, _hemicube_untouched, _hemicube_refuses
        ),
        Check(
            "hemicube_form_factors",
            "top",
            "Cells of the top have their delta form factors",
            partial(_check_part, 0, "top"),
        ),
        Check(
            "hemicube_form_factors",
            "side",
            "Cells of the sides have theirs, the lowest row first",
            partial(_check_part, 1, "side"),
        ),
        Check("hemicube_form_factors", "sum", "All cells together make 1", _hemicube_sum),
        Check(
            "hemicube_form_factors",
            "share",
            "The top has the form factor of a square",
            _hemicube_share,
        ),
        *contract_checks("gather", _gather_contract, _gather_untouched, _gather_refuses),
        Check(
            "gather", "values", "Emission, and what is reflected of what arrives", _gather_values
        ),
        Check("gather", "dark", "In the dark only lamps shine", _gather_dark),
        Check("gather", "fixed", "The solution stays as it is", _gather_fixed),
        Check("gather", "converges", "Iterations lead to the solution", _gather_converges),
        *contract_checks("shoot", _shoot_contract, _shoot_untouched, _shoot_refuses),
        Check("shoot", "received", "Receivers get brighter by what they reflect", _shoot_received),
        Check("shoot", "unshot", "What they reflect is theirs to shoot", _shoot_unshot),
        Check("shoot", "cleared", "The shooter has nothing left", _shoot_cleared),
        Check("shoot", "energy", "No power is made or lost on the way", _shoot_energy),
        Check("shoot", "converges", "Shots lead to the solution", _shoot_converges),
        *contract_checks("needs_split", _split_contract, _split_untouched, _split_refuses),
        Check("needs_split", "contrast", "Patches with enough contrast", _split_contrast),
        Check("needs_split", "scale", "Dim patches are as those in bright light", _split_scale),
        Check(
            "needs_split", "threshold", "Just over the threshold, not just under", _split_threshold
        ),
        Check("needs_split", "dark", "Black and even patches are left alone", _split_dark),
    ),
    mistakes=(
        Mistake(
            "hemicube_form_factors",
            "height-forgotten",
            "Your sides lack the cosine at the patch, which is smaller the lower the cell is.",
            partial(_cells_are, factor=lambda k: (1, 1 / _heights(k))),
        ),
        Mistake(
            "hemicube_form_factors",
            "upside-down",
            "Your sides are upside down: row 0 is the lowest.",
            _upside_down,
        ),
        Mistake(
            "hemicube_form_factors",
            "without-area",
            "Your cells lack their area: that is the density, not the share.",
            partial(_cells_are, factor=lambda k: (k * k / 4, k * k / 4)),
        ),
        Mistake(
            "hemicube_form_factors",
            "unit-area",
            "Your cells have a fourth of their area: the top is 2 x 2, not 1 x 1.",
            partial(_cells_are, factor=lambda _: (1 / 4, 1 / 4)),
        ),
        Mistake(
            "hemicube_form_factors",
            "without-pi",
            "Your factors are pi times too large.",
            partial(_cells_are, factor=lambda _: (math.pi, math.pi)),
        ),
        Mistake(
            "hemicube_form_factors",
            "not-squared",
            "Your factors fall off with r^2 only; the two cosines bring another 1 / r^2.",
            partial(_cells_are, factor=_one_power),
        ),
        Mistake(
            "gather",
            "transposed",
            "You take columns of the form factors for rows: they tell what others send, not what arrives per area.",
            partial(_gather_is, model=lambda b, e, rho, f: e + rho * (b @ f)),
        ),
        Mistake(
            "gather",
            "emission-forgotten",
            "You leave out what patches emit by themselves.",
            partial(_gather_is, model=lambda b, _, rho, f: rho * (b @ f.T)),
        ),
        Mistake(
            "gather",
            "reflectance-forgotten",
            "You leave out the reflectance: patches return all light that reaches them.",
            partial(_gather_is, model=lambda b, e, _, f: e + b @ f.T),
        ),
        Mistake(
            "gather",
            "reflected-at-sender",
            "You use the reflectance of the patch that the light comes from, instead of the one that it reaches.",
            partial(_gather_is, model=lambda b, e, rho, f: e + (rho * b) @ f.T),
        ),
        Mistake(
            "gather",
            "added-up",
            "You add to the radiosity so far: what was gathered before is gathered again.",
            partial(_gather_is, model=lambda b, _, rho, f: b + rho * (b @ f.T)),
        ),
        Mistake(
            "shoot",
            "areas-forgotten",
            "You leave out the areas: a large patch shoots more, and a small one gets brighter.",
            partial(_shoot_is, model=_shot(_no_areas)),
        ),
        Mistake(
            "shoot",
            "areas-inverted",
            "You have the ratio of the areas upside down.",
            partial(_shoot_is, model=_shot(_area_inverted)),
        ),
        Mistake(
            "shoot",
            "shoots-everything",
            "You shoot the whole radiosity again, with what has been shot before.",
            partial(_shoot_is, model=_shot(_whole_radiosity)),
        ),
        Mistake(
            "shoot",
            "reflected-at-shooter",
            "You use the shooter's reflectance; the receiver's counts.",
            partial(_shoot_is, model=_shot(_own_reflectance)),
        ),
        Mistake(
            "shoot",
            "nothing-absorbed",
            "You leave out the reflectance of the receivers.",
            partial(_shoot_is, model=_shot(_no_reflectance)),
        ),
        Mistake(
            "shoot",
            "not-cleared",
            "The shooter keeps its unshot light, and will shoot it again and again.",
            partial(_shoot_is, model=_not_cleared),
        ),
        Mistake(
            "shoot",
            "not-passed-on",
            "Receivers don't get anything to shoot: light is reflected once only.",
            partial(_shoot_is, model=_not_passed_on),
        ),
        Mistake(
            "shoot",
            "shooter-darkened",
            "You take the light that is shot away from the shooter's radiosity: it stays bright.",
            partial(_shoot_is, model=_shooter_darkened),
        ),
        Mistake(
            "needs_split",
            "absolute",
            "You compare the difference itself with the threshold, not its share of the largest value.",
            partial(_splits, model=lambda v, t: _difference(v) > t),
        ),
        Mistake(
            "needs_split",
            "own-channel",
            "You compare each channel with its own largest value; a dark one has much contrast and little light.",
            partial(_splits, model=_own_channel),
        ),
        Mistake(
            "needs_split",
            "share-of-mean",
            "You divide by the mean; contrast is a share of the largest value.",
            partial(_splits, model=_of_the_mean),
        ),
        Mistake(
            "needs_split",
            "grey",
            "You mix the channels first: red beside green of the same brightness is a contrast.",
            partial(_splits, model=_grey),
        ),
        Mistake(
            "needs_split",
            "one-for-all",
            "You divide by the largest value of all patches; each has its own.",
            partial(_splits, model=_brightest_of_all),
        ),
        Mistake(
            "needs_split",
            "or-equal",
            "You divide patches whose contrast is the threshold, too.",
            _or_equal,
        ),
    ),
)
