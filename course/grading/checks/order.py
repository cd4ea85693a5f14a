"""Convergence: evenly placed numbers stay evenly placed through a right function, and errors fall faster for it.

The mean of a smooth function over the function's points has a closed form. With Sobol numbers its error falls with an
order near 1 or better; points that the function draws by itself, or folds over, only reach 1/2.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.special import iv

from course.core.sobol import joined, owen_scrambled, shuffled, sobol_words
from course.core.types import Words
from course.grading.checks.check import Array, Check, Failure, Trial

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
    """

    rows: int
    arguments: Callable[[np.random.Generator, Array], tuple[object, ...]]
    values: Callable[[Array], Array]
    exact: float


def order_check(function: str, integral: Integral) -> Check:
    """The error falls with an order of at least ORDER."""

    def run(trial: Trial) -> None:
        errors = []
        for count in COUNTS:
            u = np.concatenate(
                [_sobol(trial.rng, count, integral.rows) for _ in range(REPEATS)], axis=1
            )
            arguments = integral.arguments(trial.rng, u if integral.rows > 1 else u[0])
            values = integral.values(np.asarray(trial.call(*arguments), np.float64))
            means = values.reshape(REPEATS, count).mean(axis=1)
            errors.append(float(np.sqrt(((means - integral.exact) ** 2).mean())))
        # Float32 sums end near 1e-7; an error there is no error.
        slope = -np.polyfit(np.log(COUNTS), np.log(np.maximum(errors, 1e-7)), 1)[0]
        if not slope >= ORDER:
            raise Failure(
                f"the error of a mean to fall with N^-{ORDER} or faster",
                f"N^-{slope:.2f}",
                ", ".join(
                    f"{error:.2g} at N = {count}"
                    for count, error in zip(COUNTS, errors, strict=True)
                ),
                "Only u may decide where a point goes, and neighbouring u should go to neighbouring points.",
            )

    return Check(
        function,
        "order",
        "Evenly placed numbers give evenly placed points",
        run,
        kind="order",
        points=0.5,
        false_fail=1e-7,
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


ORIGIN = (0.0, 0.0, 0.0)

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
            Integral(2, lambda _, u: (u,), _exponential, float(2 * iv(1, 1.0) / 1.0)),
        ),
    ),
    "glossy": (
        order_check(
            "sample_phong_lobe",
            Integral(
                2,
                lambda _, u: (
                    np.tile(np.array([[0.0], [0.0], [1.0]], u.dtype), u.shape[1]),
                    12.0,
                    u,
                ),
                lambda d: d[2] + 0.3 * d[0] + 0.2 * d[1],
                13 / 14,
            ),
        ),
    ),
    "motion_blur": (
        order_check(
            "shutter_times",
            Integral(1, lambda _, u: (0.0, 1.0, u), np.exp, float(np.e - 1)),
        ),
    ),
}
"""By module."""
