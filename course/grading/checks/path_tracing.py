"""Checks of path_tracing: the directions of diffuse bounces, what they leave of the light, and Russian roulette.

A right function may turn its directions about the normal as it likes, so only what stays the same is looked at: the
cosine, and that all turns come alike. Where a path survives by a hair, rounding decides; no check comes nearer than
``HAIR``.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from math import pi
from typing import Any

import numpy as np

from course.grading.checks.check import Array, Check, Failure, Mistake, ModuleChecks, Trial
from course.grading.checks.contract import (
    DTYPES,
    OF_THE_BATCH,
    at,
    check_array,
    check_close,
    check_refused,
    check_untouched,
    contract_checks,
    finite_numbers,
    near,
    pair,
    worst_units,
)
from course.grading.checks.statistics import CLOSE, FALSE_FAIL, apart, check_mean, check_uniform
from course.grading.checks.vectors import check_unit, cross, dot, unit_vectors

POINTS = 20_000
"""In a check of a distribution."""

HAIR = 1e-4
"""How near u comes to the probability to survive."""

BELOW = -1e-6
"""Cosines down to this count as rounding."""

POLES = np.array([[0, 0, 1], [0, 0, -1], [1, 0, 0], [0, -1, 0], [1e-4, 0, -1], [0, 1e-8, -1]]).T
"""Normals that bases have trouble with, unit length to rounding."""

MIXED = ((np.float32, np.float64), (np.float64, np.float32))


# ---------------------------------------------------------------- diffuse_bounce


def _normals(rng: np.random.Generator, n: int, dtype: Any = np.float32) -> Array:
    """Any directions, with the troublesome ones among them."""
    normals = unit_vectors(rng, n, dtype)
    some = min(n, POLES.shape[1])
    normals[:, :some] = POLES[:, :some]
    return normals


def _bounces(trial: Trial, normal: Array, u: Array) -> Array:
    """The student's directions, in double precision."""
    return finite_numbers(trial.call(normal.copy(), u.copy()), normal.shape, "the directions")


def _bounce_contract(trial: Trial) -> None:
    for dtype in DTYPES:
        u = np.concatenate((worst_units(2, dtype), trial.uniform(2, 90, dtype)), axis=1)
        for pole in POLES.T:
            normal = np.repeat(pole[:, None], u.shape[1], axis=1).astype(dtype)
            check_array(trial.call(normal, u), normal.shape, dtype, "the directions")
        for n in (u.shape[1], 1, 0):
            normal = _normals(trial.rng, n, dtype)
            check_array(trial.call(normal, u[:, :n].copy()), (3, n), dtype, "the directions")
    for first, second in MIXED:
        normal, u = _normals(trial.rng, 9, first), trial.uniform(2, 9, second)
        what = "the directions of float32 and float64"
        check_array(trial.call(normal, u), (3, 9), np.float64, what)


def _bounce_untouched(trial: Trial) -> None:
    check_untouched(trial, _normals(trial.rng, 50), trial.uniform(2, 50))


def _bounce_refuses(trial: Trial) -> None:
    normal, u = _normals(trial.rng, 4), trial.uniform(2, 4)
    for bad in (normal[:2], normal[0], normal.T):
        check_refused(trial, bad, u, named=f"normal of shape {bad.shape}")
    for bad in (u[:1], u[0], u[:, :3], u.T):
        check_refused(trial, normal, bad, named=f"u of shape {bad.shape}")


def _bounce_hemisphere(trial: Trial) -> None:
    for dtype in DTYPES:
        u = np.concatenate((worst_units(2, dtype), trial.uniform(2, 4000, dtype)), axis=1)
        normal = _normals(trial.rng, u.shape[1], dtype)
        found = _bounces(trial, normal, u)
        check_unit(found, at(normal=normal, u=u), "length of the direction:")
        cosine = dot(found, normal)
        worst = int(cosine.argmin())
        if not cosine[worst] >= BELOW:
            raise Failure(
                "directions on the normal's side, dot(direction, normal) >= 0",
                f"a cosine of {cosine[worst]:.6g}",
                at(normal=normal, u=u)(worst),
                "The hemisphere is the one about each path's own normal.",
            )


def _turns(direction: Array, normal: Array) -> Array:
    """Turn of the directions about their normals, in [0, 1), from whatever the basis begins with."""
    # Any basis will do that depends on the normal alone.
    side = np.where(np.abs(normal[2]) < 0.7, 0.0, 1.0)
    helper = np.stack((side, np.zeros_like(side), 1 - side))
    a = cross(normal, helper)
    a /= np.linalg.norm(a, axis=0)
    return np.asarray(
        np.arctan2(dot(direction, cross(normal, a)), dot(direction, a)) / (2 * pi) % 1
    )


def _bounce_density(trial: Trial) -> None:
    """Over normals of all directions, and for each of some normals."""
    batches = [("of any normals", unit_vectors(trial.rng, POINTS, np.float32))]
    for pole in (POLES[:, 0], POLES[:, 1], POLES[:, 3]):
        normal = np.repeat(pole[:, None], POINTS, axis=1).astype(np.float32)
        batches.append((f"of the normal ({', '.join(f'{x:g}' for x in pole)})", normal))
    for which, normal in batches:
        found = _bounces(trial, normal, trial.uniform(2, POINTS))
        squared = np.clip(dot(found, normal), 0, 1) ** 2
        turn = _turns(found, normal.astype(np.float64))
        if which == "of any normals":
            trial.show("histogram", "squared cosines, which should be uniform", yours=squared)
        hint = "With the density cos / pi the squared cosine is uniform from 0 to 1."
        check_uniform(squared[None], (24,), f"squared cosine {which}", hint)
        check_uniform(turn[None], (24,), f"turn {which}", "All round alike, a whole turn.")
        check_uniform(
            np.stack((squared, turn)),
            (16, 16),
            f"squared cosine and turn {which} together",
            "Each of the two numbers has to have a job of its own.",
        )


def _cosines_are(trial: Trial, model: Callable[[Array], Array]) -> bool:
    """Cosines are spread as a mistaken warp of uniform numbers spreads them."""
    normal = unit_vectors(trial.rng, 4000, np.float32)
    cosine = dot(_bounces(trial, normal, trial.uniform(2, 4000)), normal)
    return apart(cosine, model(trial.rng.random(4000))) < CLOSE


def _normal_ignored(trial: Trial) -> bool:
    u = trial.uniform(2, 200)
    some, others = (unit_vectors(trial.rng, 200, np.float32) for _ in range(2))
    return near(_bounces(trial, some, u), _bounces(trial, others, u))


def _into_surface(trial: Trial) -> bool:
    normal = unit_vectors(trial.rng, 200, np.float32)
    return bool((dot(_bounces(trial, normal, trial.uniform(2, 200)), normal) < 0).all())


def _not_normalised(trial: Trial) -> bool:
    normal = unit_vectors(trial.rng, 500, np.float32)
    length = np.linalg.norm(_bounces(trial, normal, trial.uniform(2, 500)), axis=0)
    return float(np.abs(length - 1).max()) > 0.1


# ---------------------------------------------------------------- throughput


def _colors(trial: Trial, n: int, high: float = 1.0, dtype: Any = np.float32) -> Array:
    """(3, n) positive numbers, no two channels alike."""
    return trial.rng.uniform(0.02, high, (3, n)).astype(dtype)


def _throughput_contract(trial: Trial) -> None:
    for dtype in DTYPES:
        beta, albedo = _colors(trial, 40, 3.0, dtype), _colors(trial, 40, dtype=dtype)
        beta[:, :2], albedo[:, 1:3] = 0, 0
        beta[:, 3] = np.finfo(dtype).tiny
        for n in (40, 1, 0):
            value = trial.call(beta[:, :n].copy(), albedo[:, :n].copy())
            check_array(value, (3, n), dtype, "the throughput")
    for first, second in MIXED:
        value = trial.call(_colors(trial, 9, dtype=first), _colors(trial, 9, dtype=second))
        check_array(value, (3, 9), np.float64, "the throughput of float32 and float64")


def _throughput_untouched(trial: Trial) -> None:
    check_untouched(trial, _colors(trial, 50), _colors(trial, 50))


def _throughput_refuses(trial: Trial) -> None:
    beta, albedo = _colors(trial, 4), _colors(trial, 4)
    for bad in (beta[:2], beta[0], beta.T):
        check_refused(trial, bad, albedo, named=f"beta of shape {bad.shape}")
    for bad in (albedo[:2], albedo[0], albedo[:, :3], albedo[:, 0]):
        check_refused(trial, beta, bad, named=f"albedo of shape {bad.shape}")


def _left(trial: Trial, beta: Array, albedo: Array) -> Array:
    value = trial.call(beta.copy(), albedo.copy())
    return finite_numbers(value, beta.shape, "the throughput")


def _throughput_values(trial: Trial) -> None:
    for dtype in DTYPES:
        beta, albedo = _colors(trial, 500, 3.0, dtype), _colors(trial, 500, dtype=dtype)
        check_close(
            _left(trial, beta, albedo),
            beta.astype(np.float64) * albedo,
            2e-6,
            "the throughput",
            at(beta=beta, albedo=albedo),
            "Write down f cos / pdf: what of it is left?",
        )


def _throughput_furnace(trial: Trial) -> None:
    """A room whose walls all give off 1: bounce by bounce their light adds up to 1 / (1 - albedo)."""
    albedo = trial.rng.uniform(0.1, 0.8, (3, 20))
    beta = np.ones((3, 20))
    total = np.zeros((3, 20))
    for _ in range(150):
        total += beta
        beta = np.clip(_left(trial, beta, albedo), -1e3, 1e3)
    check_close(
        total,
        1 / (1 - albedo),
        1e-5,
        "light of all bounces in a closed room, 1 / (1 - albedo) =",
        at(albedo=albedo),
        "Each bounce leaves the same share of what there was before.",
    )


def _throughput_is(trial: Trial, mistaken: Callable[[Array, Array], Array]) -> bool:
    beta, albedo = _colors(trial, 200, 2.0), _colors(trial, 200)
    return near(_left(trial, beta, albedo), mistaken(beta, albedo), 1e-5)


# ---------------------------------------------------------------- russian_roulette


def _chance(beta: Array) -> Array:
    return np.asarray(np.minimum(beta.astype(np.float64).max(axis=0), 1))


def _roulette_arguments(
    trial: Trial, n: int, high: float = 1.0, dtype: Any = np.float32
) -> tuple[Array, Array]:
    """Throughputs with any of the channels the largest, and numbers that come near to no chance."""
    beta = _colors(trial, n, high, dtype)
    u = trial.rng.random(n).astype(dtype)
    close = np.abs(u - _chance(beta)) < 2 * HAIR
    return beta, np.where(close, u / 2, u).astype(dtype)


def _played(trial: Trial, beta: Array, u: Array) -> tuple[Array, Array]:
    """Which paths survive, and their throughput in double precision."""
    survives, after = pair(trial.call(beta.copy(), u.copy()), "survives", "beta")
    n = beta.shape[1]
    if type(survives) is not np.ndarray or survives.dtype != np.bool_ or survives.shape != (n,):
        raise Failure(
            f"a bool array of shape ({n},) that says which paths survive",
            f"{getattr(survives, 'dtype', type(survives).__name__)} of shape {np.shape(survives)}",
        )
    return survives, finite_numbers(after, beta.shape, "the throughput")


def _roulette_contract(trial: Trial) -> None:
    for dtype in DTYPES:
        beta, u = _roulette_arguments(trial, 40, 2.0, dtype)
        u[:4] = 0
        beta[:, :2], beta[:, 2], beta[:, 3] = 0, np.finfo(dtype).tiny, (1, 0, 0)
        for n in (40, 1, 0):
            part = beta[:, :n].copy(), u[:n].copy()
            _, after = pair(trial.call(*part), "survives", "beta")
            check_array(after, (3, n), dtype, "the throughput")
            _played(trial, *part)
    for first, second in MIXED:
        beta, u = _roulette_arguments(trial, 9)
        _, after = pair(trial.call(beta.astype(first), u.astype(second)), "survives", "beta")
        what = "the throughput of float32 and float64"
        if getattr(after, "dtype", None) != np.float64:
            raise Failure(f"{what} of dtype float64", f"{after.dtype}", hint=OF_THE_BATCH)


def _roulette_untouched(trial: Trial) -> None:
    check_untouched(trial, *_roulette_arguments(trial, 50))


def _roulette_refuses(trial: Trial) -> None:
    beta, u = _roulette_arguments(trial, 4)
    for bad in (beta[:2], beta[0], beta.T):
        check_refused(trial, bad, u, named=f"beta of shape {bad.shape}")
    for bad in (u[:3], u[None], beta):
        check_refused(trial, beta, bad, named=f"u of shape {bad.shape}")


def _roulette_survival(trial: Trial) -> None:
    for dtype in DTYPES:
        beta, u = _roulette_arguments(trial, 2000, 1.3, dtype)
        survives, _ = _played(trial, beta, u)
        wrong = np.flatnonzero(survives != (u < _chance(beta)))
        if len(wrong):
            ray = int(wrong[0])
            goes_on = bool(survives[ray])
            raise Failure(
                f"a path to {'end' if goes_on else 'survive'} that survives with"
                f" probability {_chance(beta)[ray]:.4g}",
                f"it {'survives' if goes_on else 'ends'}; {len(wrong)} of {len(u)} are wrong",
                at(beta=beta, u=u)(ray),
                "The probability is the largest channel, and at most 1.",
            )


def _roulette_values(trial: Trial) -> None:
    for dtype in DTYPES:
        beta, u = _roulette_arguments(trial, 1000, 1.3, dtype)
        # Some that are sure to survive: the rule for the others is another check's.
        u[::3] = 0
        survives, after = _played(trial, beta, u)
        hint = "Who survives stands for those who don't; who doesn't brings nothing."
        expected = np.where(survives, beta / _chance(beta), 0)
        check_close(after, expected, 1e-5, "the throughput", at(beta=beta, u=u), hint)


def _roulette_certain(trial: Trial) -> None:
    beta, u = _roulette_arguments(trial, 300)
    beta[trial.rng.integers(3, size=300), np.arange(300)] = trial.rng.uniform(1, 4, 300)
    survives, after = _played(trial, beta, u)
    hint = "A probability is at most 1."
    if not survives.all():
        ray = int(np.argmin(survives))
        raise Failure(
            "a path with a channel of 1 or more to survive",
            "it ends",
            at(beta=beta, u=u)(ray),
            hint,
        )
    check_close(after, beta, 1e-6, "the throughput, as it was:", at(beta=beta, u=u), hint)


def _roulette_mean(trial: Trial) -> None:
    """The mean over many games is what went in."""
    for high in (0.3, 0.9):
        color = trial.rng.uniform(0.1, high, 3)
        beta = np.repeat(color[:, None], POINTS, axis=1)
        _, after = _played(trial, beta, trial.rng.random(POINTS))
        chance = float(color.max())
        for name, channel, found in zip(("red", "green", "blue"), color, after, strict=True):
            check_mean(
                found,
                float(channel),
                float(channel) ** 2 * (1 / chance - 1),
                f"mean throughput in {name} over {POINTS} games",
                "On average the roulette must change nothing.",
            )


def _roulette_is(trial: Trial, mistaken: Callable[[Array, Array], tuple[Array, Array]]) -> bool:
    """The same survivors, and the same throughput of those who survive."""
    beta, u = _roulette_arguments(trial, 400, 1.6)
    survives, after = _played(trial, beta, u)
    expected, left = mistaken(beta.astype(np.float64), u)
    return bool((survives == expected).all()) and near(after, left, 1e-4)


def _by(beta: Array, u: Array, chance: Callable[[Array], Array]) -> tuple[Array, Array]:
    """Roulette with another probability."""
    q = np.minimum(chance(beta), 1)
    return u < q, np.where(u < q, beta / q, 0)


CHECKS = ModuleChecks(
    "path_tracing",
    checks=(
        *contract_checks("diffuse_bounce", _bounce_contract, _bounce_untouched, _bounce_refuses),
        Check(
            "diffuse_bounce",
            "hemisphere",
            "Directions are unit length and on the normal's side",
            _bounce_hemisphere,
        ),
        Check(
            "diffuse_bounce",
            "density",
            "Directions have the density cos / pi about every normal",
            _bounce_density,
            "distribution",
            points=2,
            false_fail=12 * FALSE_FAIL,
        ),
        *contract_checks(
            "throughput", _throughput_contract, _throughput_untouched, _throughput_refuses
        ),
        Check("throughput", "values", "What is left is f cos / pdf of it", _throughput_values),
        Check(
            "throughput",
            "furnace",
            "In a closed room the bounces add up to 1 / (1 - albedo)",
            _throughput_furnace,
        ),
        *contract_checks(
            "russian_roulette", _roulette_contract, _roulette_untouched, _roulette_refuses
        ),
        Check(
            "russian_roulette",
            "survival",
            "Paths survive as probably as their largest channel says",
            _roulette_survival,
        ),
        Check(
            "russian_roulette",
            "values",
            "Survivors stand for the others, who bring nothing",
            _roulette_values,
        ),
        Check(
            "russian_roulette",
            "certain",
            "Bright paths survive, and stay as they are",
            _roulette_certain,
        ),
        Check(
            "russian_roulette",
            "mean",
            "The mean stays what it was",
            _roulette_mean,
            "distribution",
            false_fail=6 * FALSE_FAIL,
        ),
    ),
    mistakes=(
        Mistake(
            "diffuse_bounce",
            "normal-ignored",
            "Your directions don't depend on the normal: they are about an axis of the world.",
            _normal_ignored,
        ),
        Mistake(
            "diffuse_bounce",
            "into-surface",
            "Your directions go into the surface; the normal is on the side that the light comes from.",
            _into_surface,
        ),
        Mistake(
            "diffuse_bounce",
            "bounce-not-normalised",
            "Your directions are not of unit length.",
            _not_normalised,
        ),
        Mistake(
            "diffuse_bounce",
            "uniform-for-cosine",
            "Your directions are uniform: grazing ones come as often as steep ones.",
            partial(_cosines_are, model=lambda u: u),
        ),
        Mistake(
            "diffuse_bounce",
            "disk-crowded-centre",
            "The disk that you lift to the hemisphere is crowded at its centre.",
            partial(_cosines_are, model=lambda u: np.sqrt(1 - u * u)),
        ),
        Mistake(
            "diffuse_bounce",
            "uniform-angle",
            "Your angles from the normal are uniform: that crowds it too much.",
            partial(_cosines_are, model=lambda u: np.cos(pi / 2 * u)),
        ),
        Mistake(
            "diffuse_bounce",
            "whole-sphere",
            "Your directions cover the whole sphere; half of them go into the surface.",
            partial(_cosines_are, model=lambda u: 2 * u - 1),
        ),
        Mistake(
            "throughput",
            "over-pi",
            "You divide by pi once too often: the density of the directions has it, too.",
            partial(_throughput_is, mistaken=lambda beta, albedo: beta * albedo / pi),
        ),
        Mistake(
            "throughput",
            "times-pi",
            "You multiply by pi: the reflectance distribution is the albedo over pi.",
            partial(_throughput_is, mistaken=lambda beta, albedo: beta * albedo * pi),
        ),
        Mistake(
            "throughput",
            "before-forgotten",
            "You forget what the path had lost before: its throughput is a product over all bounces.",
            partial(_throughput_is, mistaken=lambda _, albedo: albedo),
        ),
        Mistake(
            "throughput",
            "absorbed-for-returned",
            "You keep the share that the surface swallows instead of the one that it returns.",
            partial(_throughput_is, mistaken=lambda beta, albedo: beta * (1 - albedo)),
        ),
        Mistake(
            "throughput",
            "grey",
            "You take the mean of the albedo's channels: no wall will colour another.",
            partial(_throughput_is, mistaken=lambda beta, albedo: beta * albedo.mean(axis=0)),
        ),
        Mistake(
            "russian_roulette",
            "not-divided",
            "Survivors keep the throughput that they had, so the light of those that end is lost.",
            partial(_roulette_is, mistaken=lambda b, u: (u < _chance(b), b * (u < _chance(b)))),
        ),
        Mistake(
            "russian_roulette",
            "ended-keep",
            "Survivors are right, but the paths that end keep their throughput.",
            partial(
                _roulette_is,
                mistaken=lambda b, u: (u < _chance(b), np.where(u < _chance(b), b / _chance(b), b)),
            ),
        ),
        Mistake(
            "russian_roulette",
            "ended-divided",
            "Paths that end are divided by the probability too, as if they had survived.",
            partial(_roulette_is, mistaken=lambda b, u: (u < _chance(b), b / _chance(b))),
        ),
        Mistake(
            "russian_roulette",
            "inverted",
            "Bright paths end and dark ones survive: it is the other way round.",
            partial(
                _roulette_is,
                mistaken=lambda b, u: (u >= _chance(b), b / _chance(b) * (u >= _chance(b))),
            ),
        ),
        Mistake(
            "russian_roulette",
            "mean-for-largest",
            "You take the mean of the channels for the probability; a path of one pure colour ends too soon.",
            partial(_roulette_is, mistaken=partial(_by, chance=lambda b: b.mean(axis=0))),
        ),
        Mistake(
            "russian_roulette",
            "smallest-for-largest",
            "You take the smallest channel for the probability; what little survives is much too bright.",
            partial(_roulette_is, mistaken=partial(_by, chance=lambda b: b.min(axis=0))),
        ),
        Mistake(
            "russian_roulette",
            "not-limited",
            "You divide by a probability over 1: bright paths lose light.",
            partial(
                _roulette_is, mistaken=lambda b, u: (u < b.max(0), b / b.max(0) * (u < b.max(0)))
            ),
        ),
    ),
)
