"""Convergence: evenly placed numbers stay evenly placed through a right function, and errors fall faster for it.

The mean of a smooth function over the function's points has a closed form. With Sobol numbers its error falls with an
order near 1 or better; points that the function draws by itself, or folds over, only reach 1/2. Functions that make
even points themselves are measured by these, and estimates from random numbers keep the order 1/2.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.special import iv

from course.core.sobol import joined, owen_scrambled, shuffled, sobol_words
from course.core.types import Words
from course.grading.checks.check import Array, Check, Failure, Trial
from course.grading.checks.contract import finite_floats, pair

ORDER = 0.65
COUNTS = (16, 64, 256, 1024)
REPEATS = 32


@dataclass(frozen=True)
class Integral:
    """A mean with a closed form.

    Attributes
    ----------
    rows : numbers that one point takes; 1 means that u is (N,)
    arguments : (rng, u) -> the function's arguments
    values : (result, arguments) -> (N,) values whose mean is wanted
    exact : (arguments) -> the mean
    lead : the result's shape before its last axis
    """

    rows: int
    arguments: Callable[[np.random.Generator, Array], tuple[object, ...]]
    values: Callable[[Array], Array]
    exact: float
    lead: tuple[int, ...] = (3,)


def order_check(function: str, integral: Integral) -> Check:
    """The error falls with an order of at least ORDER."""

    def run(trial: Trial) -> None:
        errors = []
        for count in COUNTS:
            u = np.concatenate(
                [_sobol(trial.rng, count, integral.rows) for _ in range(REPEATS)], axis=1
            )
            arguments = integral.arguments(trial.rng, u if integral.rows > 1 else u[0])
            shape = (*integral.lead, REPEATS * count)
            values = integral.values(finite_floats(trial.call(*arguments), shape))
            means = values.reshape(REPEATS, count).mean(axis=1)
            errors.append(_deviation(means, integral.exact))
        hint = "Only u may decide where a point goes, and neighbouring u should go to neighbouring points."
        _check_order(errors, ORDER, hint)

    return Check(
        function,
        "order",
        "Evenly placed numbers give evenly placed points",
        run,
        kind="order",
        points=0.5,
        false_fail=1e-7,
    )


def _deviation(means: Array, exact: float) -> float:
    return float(np.sqrt(((means - exact) ** 2).mean()))


def _fitted(errors: list[float]) -> float:
    """The order with which errors at COUNTS fall."""
    # Float32 sums end near 1e-7; an error there is no error.
    return float(-np.polyfit(np.log(COUNTS), np.log(np.maximum(errors, 1e-7)), 1)[0])


def _at_counts(values: list[float]) -> str:
    pairs = zip(COUNTS, values, strict=True)
    return ", ".join(f"{value:.2g} at N = {count}" for count, value in pairs)


def _check_order(errors: list[float], least: float, hint: str) -> None:
    order = _fitted(errors)
    if not order >= least:
        raise Failure(
            f"the error of a mean to fall with N^-{least} or faster",
            f"N^-{order:.2f}",
            _at_counts(errors),
            hint,
        )


def _sobol(rng: np.random.Generator, count: int, rows: int) -> Array:
    index = shuffled(np.arange(count, dtype=np.uint32), 1)[0]
    words: Words = np.concatenate([sobol_words(index), sobol_words(joined(index))])
    seeds = rng.integers(1 << 32, size=(4, 1), dtype=np.uint32)
    u: Array = (owen_scrambled(words, seeds)[:rows] >> np.uint32(8)) * np.float32(2.0**-24)
    return u


_TILT = np.array([0.6, -0.8, 0.5])
_LENGTH = float(np.sqrt((_TILT**2).sum()))


def _exponential(points: Array) -> Array:
    tilt = _TILT[: len(points)]
    values: Array = np.exp(np.tensordot(tilt, points, 1))
    return values


def _sinhc(a: float) -> float:
    return float(np.sinh(a) / a)


def _leaning(directions: Array) -> Array:
    """Height and a share of x and y, whose means about +z are 0."""
    values: Array = directions[2] + 0.3 * directions[0] + 0.2 * directions[1]
    return values


ORIGIN = (0.0, 0.0, 0.0)

EVEN = 0.75
"""Order of point sets: near 1, less powers of log N."""


def _starts(trial: Trial, count: int) -> Array:
    """The mean over runs of so many points of Halton's sequence, wherever they begin."""
    begins = trial.rng.integers(0, 1 << 20, REPEATS)
    i = (begins[:, None] + np.arange(count)).ravel()
    values = _exponential(finite_floats(trial.call(i, 3), (3, i.size)))
    means: Array = values.reshape(REPEATS, count).mean(axis=1)
    return means


def _turned(trial: Trial, count: int) -> Array:
    """The mean over Hammersley's set, moved by random vectors around the unit cube."""
    points = finite_floats(trial.call(count, 3), (3, count))
    by = trial.rng.random((3, REPEATS, 1))
    means: Array = _exponential((points[:, None] + by) % 1).mean(axis=1)
    return means


def _points_order(function: str, means: Callable[[Trial, int], Array]) -> Check:
    """The error of a mean over the function's own points falls nearly with 1 / N."""
    tilt = _TILT.tolist()
    exact = float(np.prod([np.expm1(a) / a for a in tilt]))

    def run(trial: Trial) -> None:
        errors = [_deviation(means(trial, count), exact) for count in COUNTS]
        _check_order(errors, EVEN, "Random points reach N^-0.5: yours are to be more even.")

    return Check(
        function,
        "order",
        "The error of a mean falls nearly with 1 / N",
        run,
        kind="order",
        points=0.5,
        false_fail=1e-7,
    )


ESTIMATES = 64
"""For each number of samples."""


def _estimates(trial: Trial) -> None:
    """Estimates of the hemisphere's integral of cos^2 from uniform directions, 2 pi / 3."""
    errors, told = [], []
    for count in COUNTS:
        density = np.full(count, 1 / (2 * np.pi))
        found = [
            [finite_floats(np.asarray(number), ()) for number in pair(value, "mean", "variance")]
            for cos in trial.rng.random((ESTIMATES, count))
            for value in (trial.call(cos * cos, density),)
        ]
        means, variances = np.array(found).T
        errors.append(_deviation(means, 2 * np.pi / 3))
        told.append(float(variances.mean()))
    alike = "Four times the samples, half the error: each sample counts, and all count alike."
    mean = "It is the variance of the mean, whose square root is the error."
    for values, wanted, expected, hint in (
        (errors, 0.5, "the error to fall with N^-0.5", alike),
        (told, 1, "the variance that it tells to fall with 1 / N", mean),
    ):
        order = _fitted(values)
        if not abs(order - wanted) <= ESTIMATED:
            raise Failure(expected, f"N^-{order:.2f}", _at_counts(values), hint)


ESTIMATED = 0.25
"""How far a fitted order may be off: one of 64 estimates has a standard deviation below 0.033."""

_UPWARDS = np.array([[0.0], [0.0], [1.0]])


def _upwards(u: Array) -> Array:
    """+z in each column."""
    return np.tile(_UPWARDS.astype(u.dtype), u.shape[1])


ORDERS: dict[str, tuple[Check, ...]] = {
    "soft_shadows": (
        order_check(
            "point_on_rectangle",
            Integral(
                2,
                lambda _, u: ((-1.0, -1.0, 0.0), (2.0, 0.0, 0.0), (0.0, 2.0, 0.0), u),
                _exponential,
                _sinhc(float(_TILT[0])) * _sinhc(float(_TILT[1])),
            ),
        ),
        order_check(
            "point_on_sphere",
            Integral(2, lambda _, u: (ORIGIN, 1.0, u), _exponential, _sinhc(_LENGTH)),
        ),
        order_check(
            "point_in_ball",
            Integral(
                3,
                lambda _, u: (ORIGIN, 1.0, u),
                _exponential,
                float(3 * (_LENGTH * np.cosh(_LENGTH) - np.sinh(_LENGTH)) / _LENGTH**3),
            ),
        ),
    ),
    "thin_lens": (
        order_check(
            "point_on_disk",
            Integral(2, lambda _, u: (u,), _exponential, float(2 * iv(1, 1.0) / 1.0), (2,)),
        ),
    ),
    "glossy": (
        order_check(
            "sample_phong_lobe",
            Integral(
                2,
                lambda _, u: (_upwards(u), 12.0, u),
                _leaning,
                13 / 14,
            ),
        ),
    ),
    "motion_blur": (
        order_check(
            "shutter_times",
            Integral(1, lambda _, u: (0.0, 1.0, u), np.exp, float(np.e - 1), ()),
        ),
    ),
    "sampling": (
        order_check(
            "disk_by_polar",
            Integral(2, lambda _, u: (u,), _exponential, float(2 * iv(1, 1.0) / 1.0), (2,)),
        ),
        order_check(
            "ball_by_polar",
            Integral(
                3,
                lambda _, u: (u,),
                _exponential,
                float(3 * (_LENGTH * np.cosh(_LENGTH) - np.sinh(_LENGTH)) / _LENGTH**3),
            ),
        ),
        order_check(
            "sphere_by_polar", Integral(2, lambda _, u: (u,), _exponential, _sinhc(_LENGTH))
        ),
    ),
    "importance_sampling": (
        # Means of z: of a half sphere's points 1/2, of their projection 2/3; those of x and y are 0.
        order_check("uniform_hemisphere", Integral(2, lambda _, u: (u,), _leaning, 1 / 2)),
        order_check("cosine_hemisphere", Integral(2, lambda _, u: (u,), _leaning, 2 / 3)),
        Check(
            "estimate",
            "order",
            "The error falls with N^-0.5, and the variance with 1 / N",
            _estimates,
            kind="order",
            points=0.5,
            false_fail=1e-7,
        ),
    ),
    "quasi_monte_carlo": (
        _points_order("halton", _starts),
        _points_order("hammersley", _turned),
    ),
    "path_tracing": (
        order_check("diffuse_bounce", Integral(2, lambda _, u: (_upwards(u), u), _leaning, 2 / 3)),
    ),
}
"""By module."""
